#pragma once

/// The pairs that meet, kept from frame to frame: each frame says only what has begun and what has ended.

#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>

#include "pipeline/broad_phase.h"
#include "pipeline/pair_table.h"
#include "pipeline/tracked_pair.h"

namespace glissade::collision {

class MeetingList {
 public:
  /// A pair that has just been found to meet, and did not before.
  void begin(const TrackedPair& pair, PairTable::Number number) { met_.push_back({pair.slots, number}); }

  /// A pair that has just been found not to meet, and did before.
  void end(const TrackedPair& pair, PairTable::Number number) { parted_.push_back({pair.slots, number}); }

  /// A pair that is apart without a test, whether it met before or not.
  void part(TrackedPair& pair, PairTable::Number number) {
    if (pair.meets) end(pair, number);
    pair.meets = false;
  }

  /// Brings the pairs that meet, and the account, in `result` up to date. Returns whether they have changed.
  bool update(const World& world, FrameResult& result);

  /// Copies the triangles of all pairs that meet into `result`.
  void copy_details(PairTable& pairs, FrameResult& result) const;

 private:
  /// Two objects that meet, or did. In the order of their slots.
  struct Meeting {
    SlotPair slots;
    PairTable::Number number;

    bool operator<(const Meeting& other) const { return slots < other.slots; }
  };

  std::vector<Meeting> met_;     ///< since the last update
  std::vector<Meeting> parted_;  ///< since the last update
  std::vector<Meeting> meeting_;
  std::vector<Meeting> kept_;
};

}  // namespace glissade::collision
