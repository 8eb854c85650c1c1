#pragma once

/// Argument checks of set-up code. Each throws std::invalid_argument, with a sentence that names the argument and its
/// value.

#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace glissade::base {

inline void require_positive(const char* name, double value) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream message;
  message << name << " must be positive and finite, but is " << value << ".";
  throw std::invalid_argument(message.str());
}

inline void require_triangle_count(std::int64_t triangle_count) {
  if (triangle_count >= 1 && triangle_count <= 50'000'000) return;
  std::ostringstream message;
  message << "triangle_count must be from 1 to 50000000, but is " << triangle_count << ".";
  throw std::invalid_argument(message.str());
}

inline void require_count(const char* name, int value, int least, int most, int multiple = 1) {
  if (value >= least && value <= most && value % multiple == 0) return;
  std::ostringstream message;
  message << name << " must be from " << least << " to " << most;
  if (multiple > 1) message << " and a multiple of " << multiple;
  message << ", but is " << value << ".";
  throw std::invalid_argument(message.str());
}

inline void require_between(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  std::ostringstream message;
  message << name << " must be from " << least << " to " << most << ", but is " << value << ".";
  throw std::invalid_argument(message.str());
}

inline void require_below(const char* name, double value, const char* limit_name, double limit) {
  if (value < limit) return;
  std::ostringstream message;
  message << name << " must be less than " << limit_name << ", which is " << limit << ", but is " << value << ".";
  throw std::invalid_argument(message.str());
}

}  // namespace glissade::base
