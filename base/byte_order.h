#pragma once

/// Conversion between numbers and their bytes in files.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include <glissade/base/assert.h>

namespace glissade::base {

/// The number whose bytes start at `offset`; all of them must lie within `bytes`.
template <class Number>
Number number_at(std::string_view bytes, std::size_t offset, std::endian order = std::endian::little) {
  GLISSADE_ASSERT(offset <= bytes.size() && bytes.size() - offset >= sizeof(Number));
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), bytes.data() + offset, sizeof(Number));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Appends the bytes of the number.
template <class Number>
void append_number(std::string& bytes, Number number, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace glissade::base
