#pragma once

/// The vector code of `coherent_front.h`.

#include <cstddef>
#include <cstdint>
#include <span>

namespace glissade::collision {

/// The number of values must be a multiple of this.
inline constexpr std::size_t kFrontPadding = 16;

/// Writes the indices of all values that are at most `clock` to `expired`, in ascending order, and returns their
/// number. `expired` must have room for all values.
std::size_t find_expired(std::span<const float> expiry, float clock, std::span<std::uint32_t> expired);

}  // namespace glissade::collision
