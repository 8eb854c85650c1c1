#pragma once

/// One random scene of sliding contact, with checks in every millisecond of all that must hold. The checks share no
/// code with the simulation: `GridCheck` for poses, `SweptCheck` for paths and distances.

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::test_support {

/// The figures of one or several scenes.
struct TortureCounts {
  std::int64_t scenes = 0;
  std::int64_t ticks = 0;
  std::int64_t held = 0;                 ///< ticks in which the hand held the part
  std::int64_t pushed = 0;               ///< ticks in which contacts pushed
  std::int64_t moved = 0;                ///< ticks in which the part moved
  std::int64_t collisions = 0;           ///< visible poses that collide
  std::int64_t paths = 0;                ///< motions between visible poses that are known in full; all are checked
  std::int64_t partial_paths = 0;        ///< motions of which only the last step is known
  std::int64_t unproved_paths = 0;       ///< motions of either kind, not proved free
  std::int64_t below_min_clearance = 0;  ///< poses nearer than allowed
  double least_of_min_clearance =
      1e300;  ///< smallest distance over the minimum clearance; without parts that started nearer
  std::int64_t not_finite = 0;
  std::int64_t wanted = 0;       ///< ticks with the target elsewhere: see `torture_run.cpp`
  std::int64_t jammed = 0;       ///< of these, the part stood still and could have moved
  std::int64_t jammed_near = 0;  ///< the same for parts that started nearer than the minimum clearance and still are
  std::int64_t unbalanced = 0;   ///< ticks with the target elsewhere in which the part stood still off balance
  /// Greatest change of the force under force feedback in a tick, over k_t (0.2 mm + g), with the motion bound g of the
  /// ghost. The other metaphors catch up at once.
  double force_jump = 0.0;
  std::uint64_t hash = 0;  ///< of all visible poses, states and forces
  std::int64_t fault_count = 0;
  std::vector<std::string> faults;  ///< the first few of each scene, in words

  /// Adds the figures of later scenes.
  void add(const TortureCounts& later);
};

struct TortureOptions {
  bool has_search_thread = false;  ///< the simulation searches in a thread of its own
  bool is_off_centre = false;      ///< the compliance point of the part lies up to two radii from its centre
  bool has_fits = false;           ///< scenes of machine elements that fit each other (`fit_scene.h`)
};

/// Runs scene `index` of a seed for `milliseconds` ticks. The result does not depend on time, machine or thread, nor on
/// `has_search_thread`.
TortureCounts run_torture_scene(std::uint64_t seed, std::int64_t index, int milliseconds,
                                const TortureOptions& options = {});

}  // namespace glissade::test_support
