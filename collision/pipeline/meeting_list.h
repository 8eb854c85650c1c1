#pragma once

/// The pairs that meet, kept from frame to frame: each frame reports only the changes.

#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>

#include "pipeline/broad_phase.h"
#include "pipeline/pair_table.h"
#include "pipeline/tracked_pair.h"

namespace glissade::collision {

class MeetingList {
 public:
  /// Adds a pair that was found to meet and did not meet before.
  void begin(const TrackedPair& pair, PairTable::Number number) { met_.push_back({pair.slots, number}); }

  /// Removes a pair that met before and was found to meet no longer.
  void end(const TrackedPair& pair, PairTable::Number number) { parted_.push_back({pair.slots, number}); }

  /// Notes that a pair is apart, without a test. It may have met before or not.
  void part(TrackedPair& pair, PairTable::Number number) {
    if (pair.meets) end(pair, number);
    pair.meets = false;
  }

  /// Updates the pairs that meet in `result`, and their counts in its report. Returns whether the pairs have changed.
  bool update(const World& world, FrameResult& result);

  /// Copies the triangles of all pairs that meet into `result`.
  void copy_details(PairTable& pairs, FrameResult& result) const;

 private:
  /// Two objects that meet or have met. Ordered by slots.
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
