#pragma once

/// Numbers of the groups of four offsets that an alignment combines.

#include <cstddef>
#include <cstdint>

namespace glissade::collision {

/// The number of a quarter line (FourValues) of a node; each row has two. The sign bit is set if the number is 16 or
/// more, for vector code that looks up 16 at once.
using QuarterLine = std::uint64_t;
constexpr QuarterLine quarter_line(std::size_t number) {
  return number | (number >= 16 ? std::uint64_t{1} << 63 : 0);
}
constexpr std::size_t number_of(QuarterLine quarter) {
  return quarter & 0xff;
}

}  // namespace glissade::collision
