#pragma once

/// A number for each finger, and the joints of a hand whose fingers curl.

#include <array>
#include <cstddef>

#include <glissade/hands/hand.h>

namespace glissade::bridges {

inline constexpr std::size_t kFingers = 5;

/// One number for each finger, from the thumb to the little finger. A curl is 0 for a finger that is open, and 1 for
/// one that is closed.
using FingerValues = std::array<double, kFingers>;

/// The angles (rad) of all joints. Joints that do not curl have fixed angles: the thumb opposite to the palm, fingers
/// side by side, a straight wrist.
hands::JointValues angles_of(const FingerValues& curls) noexcept;

}  // namespace glissade::bridges
