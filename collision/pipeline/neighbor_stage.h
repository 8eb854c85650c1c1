#pragma once

/// Stage 1 of the pipeline: finds the pairs that may have come near each other or met, or parted again.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>

#include "pipeline/broad_phase.h"
#include "pipeline/meeting_list.h"
#include "pipeline/pair_table.h"
#include "pipeline/placed_objects.h"
#include "pipeline/queue_stage.h"

namespace glissade::collision {

class NeighborStage {
 public:
  NeighborStage(const World& world, const PlacedObjects& placed, BroadPhase& broad_phase, PairTable& pairs,
                MeetingList& meetings);

  /// Replaces `candidates` by the enabled pairs that may be within `distance` (metres). Considers pairs with an object
  /// that has moved, or all tracked pairs if the distance differs from that of the last frame. `frame` is the number of
  /// the frame.
  void find(const QueueStage& queue, std::uint64_t frame, double distance, std::vector<PairTable::Number>& candidates,
            StageReport& report);

 private:
  void track(const SlotPair& slots);
  void forget(const SlotPair& slots);
  void renew_interest(PairTable::Number number);
  void consider_changed(const QueueStage& queue);
  void consider_changed_in_order(const QueueStage& queue);
  void consider(PairTable::Number number);

  const World& world_;
  const PlacedObjects& placed_;
  BroadPhase& broad_phase_;
  PairTable& pairs_;
  MeetingList& meetings_;

  // State of the current frame.
  std::uint32_t frame_ = 0;  ///< low bits of its number
  double distance_ = 0.0;
  std::vector<PairTable::Number>* candidates_ = nullptr;
  std::int64_t considered_ = 0;

  std::vector<std::uint8_t> has_changed_;  ///< by slot; all 0 between frames
};

}  // namespace glissade::collision
