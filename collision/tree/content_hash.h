#pragma once

/// A hash that detects changes. Not secure against forgery.

#include <cstdint>
#include <string>
#include <string_view>

#include <glissade/base/byte_order.h>

namespace glissade::collision {

// Hash of a sequence of 64-bit words. Every step is a bijection, so sequences that differ in exactly one word have
// different values.
class ContentHash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15U;
    value_ ^= value_ >> 32U;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x243f6a8885a308d3U;
};

inline std::uint64_t content_hash(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes.size());
  for (; bytes.size() >= 8; bytes.remove_prefix(8))
    hash.add(base::number_at<std::uint64_t>(bytes, 0));
  std::string rest(bytes);
  rest.resize(8);
  hash.add(base::number_at<std::uint64_t>(rest, 0));
  return hash.value();
}

}  // namespace glissade::collision
