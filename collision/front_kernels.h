#pragma once

/// The vector code of `coherent_front.h`.

#include <cstddef>
#include <cstdint>
#include <span>

namespace glissade::collision {

/// Values come in multiples of it.
inline constexpr std::size_t kFrontPadding = 16;

/// Writes the places of all values that are not greater than `clock` to `expired`, in ascending order, and returns how
/// many there are. `expired` has room for all of them.
std::size_t find_expired(std::span<const float> expiry, float clock, std::span<std::uint32_t> expired);

}  // namespace glissade::collision
