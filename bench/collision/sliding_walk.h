#pragma once

/// A path of one object along another as a hand would slide it: many small steps near contact.

#include <vector>

#include <Eigen/Geometry>

#include "pose_source.h"

namespace glissade::bench {

/// One stretch of the path: how far the objects stay apart.
struct SlidingPhase {
  const char* name;
  double gap;  ///< in metres; negative: it goes on to slide inside the other object, about so deep
};

struct SlidingStep {
  double length;  ///< of every step, in metres
  double angle;   ///< of every step, in radians
};

/// One part for each phase, of `frames` poses each; all steps are equal in length and angle, but turn smoothly about at
/// random. The gap is that of the phase to within a few steps, after the way from one phase to the next.
std::vector<std::vector<Eigen::Isometry3d>> sliding_walk(const collision::DopTree& tree_A,
                                                         const collision::DopTree& tree_B,
                                                         const std::vector<SlidingPhase>& phases, std::size_t frames,
                                                         const SlidingStep& step, std::uint64_t seed);

}  // namespace glissade::bench
