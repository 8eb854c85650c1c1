#pragma once

/// A path of one object along another as a hand would slide it: many small steps near contact.

#include <vector>

#include <Eigen/Geometry>

#include "pose_source.h"

namespace glissade::bench {

/// One stretch of the path, with the gap between the objects.
struct SlidingPhase {
  const char* name;
  double gap;  ///< metres; negative: depth at which it slides inside the other object, about
};

struct SlidingStep {
  double length;  ///< of every step, in metres
  double angle;   ///< of every step, in radians
};

/// For objects of size 2, as a part of 0.1 m in steps of 10 micrometres and 0.006 degrees.
inline constexpr SlidingStep kSmallStep{.length = 2e-4, .angle = 1e-4};

/// One part for each phase, of `frames` poses each. All steps have equal length and angle; their directions change
/// smoothly at random. After the transition from one phase to the next, the gap is that of the phase within a few
/// steps.
std::vector<std::vector<Eigen::Isometry3d>> sliding_walk(const collision::DopTree& tree_A,
                                                         const collision::DopTree& tree_B,
                                                         const std::vector<SlidingPhase>& phases, std::size_t frames,
                                                         const SlidingStep& step, std::uint64_t seed);

}  // namespace glissade::bench
