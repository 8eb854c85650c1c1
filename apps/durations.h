#pragma once

/// Durations as numbers.

#include <chrono>

namespace glissade::apps {

inline double in_seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

inline double in_microseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

}  // namespace glissade::apps
