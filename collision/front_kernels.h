#pragma once

/// The vector code of `coherent_front.h`.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace glissade::collision {

/// Values come in multiples of it.
inline constexpr std::size_t kFrontPadding = 16;

/// Replaces `expired` by the places of all values that are not greater than `clock`, in ascending order.
void find_expired(std::span<const float> expiry, float clock, std::vector<std::uint32_t>& expired);

}  // namespace glissade::collision
