#pragma once

#include <bit>
#include <cstdint>

namespace glissade::collision {

/// The smallest float that is not less than `value`, for |value| within the range of float. Whether the nearest is less
/// cannot be foretold, so that there is no branch on it.
inline float round_up_to_float(double value) {
  const auto nearest = static_cast<float>(value);
  const auto is_less = static_cast<std::int32_t>(static_cast<double>(nearest) < value);
  const std::int32_t bits = std::bit_cast<std::int32_t>(nearest);
  const std::int32_t sign = bits >> 31 | 1;  // the bits of a negative number count downward
  return std::bit_cast<float>(bits + sign * is_less);
}

}  // namespace glissade::collision
