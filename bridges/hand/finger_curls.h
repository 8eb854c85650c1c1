#pragma once

/// The joints of fingers that curl: what a finger does of which only the curl is known.

#include <array>
#include <cstddef>
#include <numbers>
#include <string_view>

#include <glissade/bridges/finger_values.h>
#include <glissade/hands/hand.h>

namespace glissade::bridges {

/// A joint that turns with the curl of its finger, from the open hand to the fist.
struct CurlingJoint {
  std::size_t finger;
  std::size_t joint;  ///< index in `hands::kJointNames`
  double open;        ///< rad
  double closed;      ///< rad; may be less
};

inline constexpr std::size_t kJointsOfFinger = 3;

/// The joints of a finger turn together.
const std::array<CurlingJoint, kFingers * kJointsOfFinger>& curling_joints() noexcept;

/// The ranges of the joints that curl. 0 for the others.
hands::JointValues lower_angles() noexcept;
hands::JointValues upper_angles() noexcept;

}  // namespace glissade::bridges
