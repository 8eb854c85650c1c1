#pragma once

/// Constants that several stages of a simulation cycle share.

#include <limits>

#include <glissade/contact/spring.h>

namespace glissade::contact {

inline constexpr double kLargestReach_m = 3e-3;
inline constexpr double kMostLookAhead_m = 0.375e-3;
inline constexpr double kNotWorthIt = 0.05;  ///< of the margin: a shorter step counts as none
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Metres a millisecond by which the offset of a grasp shrinks under force feedback: half of the slew, so that the part
/// can also slide and follow the ghost meanwhile.
inline constexpr double kClosing_m = 0.5 * kSlew_m;

}  // namespace glissade::contact
