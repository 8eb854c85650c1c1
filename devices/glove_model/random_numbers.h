#pragma once

/// Random numbers that are the same bits with every compiler and library. The distributions of the standard library are
/// not.

#include <cstdint>
#include <random>

namespace glissade::devices {

class RandomNumbers {
 public:
  /// Streams of one seed are independent of each other.
  RandomNumbers(std::uint64_t seed, std::uint64_t stream) : engine_(seed * 0x9E3779B97F4A7C15U + stream) {}

  /// From 0 to 1, without 1.
  double uniform() noexcept { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

  /// Mean 0, standard deviation 1: the sum of twelve uniform numbers (Irwin–Hall), so at most 6. Needs no logarithm,
  /// which libraries round differently.
  double normal() noexcept {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const std::uint64_t bits = engine_();
      for (unsigned shift = 0; shift < 64; shift += 16)
        sum += static_cast<double>(bits >> shift & 0xFFFFU) + 0.5;
    }
    return sum * 0x1p-16 - 6.0;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace glissade::devices
