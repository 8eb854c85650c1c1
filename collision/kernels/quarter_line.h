#pragma once

/// How alignments name the values of a node that they combine.

#include <cstddef>
#include <cstdint>

namespace glissade::collision {

/// A quarter line (FourValues) of a node, two for each row: its number, and in the sign bit whether that is 16 or more,
/// for vector code that looks up 16 at once.
using QuarterLine = std::uint64_t;
constexpr QuarterLine quarter_line(std::size_t number) {
  return number | (number >= 16 ? std::uint64_t{1} << 63 : 0);
}
constexpr std::size_t number_of(QuarterLine quarter) {
  return quarter & 0xff;
}

}  // namespace glissade::collision
