#pragma once

/// One random scene of sliding contact with everything checked that must hold in every millisecond, by code that shares
/// nothing with the simulation: `GridCheck` for poses, `SweptCheck` for paths and distances.

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::test_support {

/// What was seen in one or several scenes.
struct TortureCounts {
  std::int64_t scenes = 0;
  std::int64_t ticks = 0;
  std::int64_t held = 0;        ///< ticks in which the hand held the part
  std::int64_t pushed = 0;      ///< ticks in which contacts pushed
  std::int64_t moved = 0;       ///< ticks in which the part moved
  std::int64_t collisions = 0;  ///< visible poses that collide
  std::int64_t paths = 0;       ///< motions from one visible pose to the next that are known in full and were checked
  std::int64_t partial_paths = 0;   ///< of which only the last step is known
  std::int64_t unproved_paths = 0;  ///< of either, not proved free
  std::int64_t below_floor = 0;     ///< poses nearer than they may be
  double least_of_floor = 1e300;    ///< least distance, as a part of the floor, of parts that did not start nearer
  std::int64_t not_finite = 0;
  std::int64_t wanted = 0;       ///< ticks in which the hand wanted the part elsewhere: see `torture_run.cpp`
  std::int64_t jammed = 0;       ///< of these, the part stood still and could have moved
  std::int64_t jammed_near = 0;  ///< the same of parts that started nearer than the floor and have not come away yet
  std::int64_t unbalanced = 0;   ///< of these, it stood still and the contacts' forces do not balance the spring's
  /// Greatest change of the force under force feedback in a tick, as a part of kt (0.2 mm + |ΔG|), |ΔG| being how far
  /// any point of the ghost went. The other metaphors catch up at once.
  double force_jump = 0.0;
  std::uint64_t hash = 0;  ///< of all visible poses, states and forces
  std::int64_t fault_count = 0;
  std::vector<std::string> faults;  ///< the first few of each scene, in words

  /// What came after it.
  void add(const TortureCounts& later);
};

/// Scene `index` of a seed for so many milliseconds. The same whenever and wherever it is run, and whether or not the
/// simulation searches in a thread of its own.
TortureCounts run_torture_scene(std::uint64_t seed, std::int64_t index, int milliseconds,
                                bool has_search_thread = false);

}  // namespace glissade::test_support
