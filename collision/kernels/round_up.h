#pragma once

#include <bit>
#include <cstdint>

namespace glissade::collision {

/// The smallest float that is not less than `value`, for |value| within the range of float. Free of branches, because
/// the direction of rounding is unpredictable.
inline float round_up_to_float(double value) {
  const auto nearest = static_cast<float>(value);
  const auto is_less = static_cast<std::int32_t>(static_cast<double>(nearest) < value);
  const std::int32_t bits = std::bit_cast<std::int32_t>(nearest);
  const std::int32_t sign = bits >> 31 | 1;  // increasing the bits of a negative number lowers it
  return std::bit_cast<float>(bits + sign * is_less);
}

}  // namespace glissade::collision
