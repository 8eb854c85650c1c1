#pragma once

/// The vector code of `coherent_front.h`.

#include <cstddef>
#include <cstdint>
#include <span>

namespace glissade::collision {

/// The number of values must be a multiple of it.
inline constexpr std::size_t kFrontPadding = 16;

/// Writes the places of all values that are not greater than `clock` to `expired`, in ascending order, and returns how
/// many there are. `expired` must have room for all
/// values.
std::size_t find_expired(std::span<const float> expiry, float clock, std::span<std::uint32_t> expired);

}  // namespace glissade::collision
