#pragma once

#include <bit>
#include <cstdint>

namespace glissade::collision {

/// The smallest float that is not less than `value`, for |value| within the range of float.
inline float round_up_to_float(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) >= value) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(nearest) + (nearest >= 0.0F ? 1 : -1));
}

}  // namespace glissade::collision
