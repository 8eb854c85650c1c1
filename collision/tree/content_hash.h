#pragma once

/// A hash to notice changes by; no guard against forgery.

#include <cstdint>
#include <string>
#include <string_view>

#include <glissade/base/byte_order.h>

namespace glissade::collision {

// Of 64-bit words. Every step can be undone, so sequences that differ in one word never share a value.
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
