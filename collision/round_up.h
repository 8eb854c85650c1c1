#pragma once

#include <cmath>
#include <limits>

namespace glissade::collision {

/// The smallest float that is not less than `value`, for |value| within the range of float.
inline float round_up_to_float(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) >= value) return nearest;
  return std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

}  // namespace glissade::collision
