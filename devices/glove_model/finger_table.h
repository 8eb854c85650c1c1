#pragma once

/// The joints of the fingers, and their inertia.

#include <array>
#include <cstddef>
#include <numbers>

#include <glissade/hands/hand.h>

namespace glissade::devices {

constexpr double radians(double degrees) noexcept {
  return degrees * std::numbers::pi / 180.0;
}

/// The flexions of each finger, thumb to little finger, as indices of `hands::kJointNames`.
inline constexpr std::array<std::array<std::size_t, 3>, 5> kFlexionsOfFingers{
    {{0, 1, 2}, {4, 5, 6}, {7, 8, 9}, {11, 12, 13}, {15, 16, 17}}};

/// The part of a hand that a joint carries.
struct CarriedPart {
  double inertia;  ///< about the joint, kg m²
  double lever;    ///< distance of the fingertip from the joint, m
};

// Cylinders of 1100 kg/m³ and of the size of an index finger: 45, 25 and 25 mm long, 18, 16 and 14 mm thick. The finger
// is straight. The hand is a rod of 0.4 kg and 0.19 m.
inline constexpr CarriedPart kFinger{5.6e-5, 0.095};
inline constexpr CarriedPart kMiddleAndTip{7.3e-6, 0.050};
inline constexpr CarriedPart kTip{8.8e-7, 0.025};
inline constexpr CarriedPart kHand{4.8e-3, 0.19};

/// In the order of `hands::kJointNames`.
inline constexpr std::array<CarriedPart, hands::kJoints> kCarriedParts{
    {kFinger, kMiddleAndTip, kTip, kFinger, kFinger, kMiddleAndTip, kTip, kFinger, kMiddleAndTip, kTip,  kFinger,
     kFinger, kMiddleAndTip, kTip, kFinger, kFinger, kMiddleAndTip, kTip, kFinger, kFinger,       kHand, kHand}};

}  // namespace glissade::devices
