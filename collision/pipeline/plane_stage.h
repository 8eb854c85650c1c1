#pragma once

/// Stage 2 of the pipeline: separating planes between the convex hulls of candidates.

#include <cstdint>
#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>

#include "pipeline/pair_table.h"
#include "pipeline/placed_objects.h"
#include "pipeline/thread_pool.h"
#include "pipeline/tracked_pair.h"

namespace glissade::collision {

class PlaneStage {
 public:
  PlaneStage(const World& world, const PlacedObjects& placed, const PipelineOptions& options, PairTable& pairs,
             ThreadPool& pool)
      : world_(world), placed_(placed), options_(options), pairs_(pairs), pool_(pool) {}

  /// Replaces `near` by the candidates that no plane certainly separates by more than `distance` (metres), and notes
  /// the separation of the others. A pair that met in the last frame is passed on without a test, because mostly it
  /// still meets.
  void filter(const std::vector<PairTable::Number>& candidates, double distance, std::vector<PairTable::Number>& near,
              StageReport& report);

 private:
  bool may_be_near(PairTable::Number number, double distance);
  bool are_separated(TrackedPair& pair, PairMemory& memory, double distance) const;

  const World& world_;
  const PlacedObjects& placed_;
  const PipelineOptions& options_;
  PairTable& pairs_;
  ThreadPool& pool_;
  std::vector<std::uint8_t> is_near_;  ///< by candidate
};

}  // namespace glissade::collision
