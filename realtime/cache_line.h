#pragma once

/// The distance that keeps data of two threads out of each other's cache lines.

#include <cstddef>

namespace glissade::realtime {

/// Bytes. A constant of our own: std::hardware_destructive_interference_size may differ between translation units.
inline constexpr std::size_t kCacheLineBytes = 64;

}  // namespace glissade::realtime
