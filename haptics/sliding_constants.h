#pragma once

/// What the sources of `joint_sliding.h` have in common.

#include <limits>

namespace glissade::haptics {

inline constexpr double kLargestReach_m = 3e-3;
inline constexpr double kMostLookAhead_m = 0.75e-3;
inline constexpr double kNotWorthIt = 0.05;  ///< a step below this part of the margin is as good as none
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

}  // namespace glissade::haptics
