#pragma once

/// Angles in degrees, for numbers in the code and in sentences.

#include <cmath>
#include <numbers>
#include <string>

namespace glissade::bridges {

constexpr double radians(double degrees) noexcept {
  return degrees * std::numbers::pi / 180.0;
}

/// Whole degrees, such as "12 deg", of an angle in rad.
inline std::string degrees_text(double angle) {
  return std::to_string(std::lround(angle / radians(1.0))) + " deg";
}

}  // namespace glissade::bridges
