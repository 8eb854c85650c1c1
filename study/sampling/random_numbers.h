#pragma once

/// Random numbers that are the same on every machine.

#include <cstdint>
#include <initializer_list>
#include <random>
#include <utility>
#include <vector>

namespace glissade::study {

/// A generator for this stream of random numbers. Generator and seed sequence are defined by the standard to the bit.
inline std::mt19937_64 generator_of(std::uint64_t seed, std::uint64_t stream) {
  const std::initializer_list<std::uint64_t> words{seed & 0xffffffffU, seed >> 32U, stream & 0xffffffffU,
                                                   stream >> 32U};
  std::seed_seq sequence(words);
  return std::mt19937_64(sequence);
}

/// Between 0 and 1, both excluded.
inline double share_of(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

/// Shuffles the elements. `std::shuffle` differs between standard libraries.
template <typename Element>
void shuffle(std::vector<Element>& elements, std::mt19937_64 generator) {
  for (std::size_t i = elements.size(); i > 1; --i)
    std::swap(elements[i - 1], elements[generator() % i]);
}

// Streams of random numbers beside those of the slides, which have the numbers from 0.
inline constexpr std::uint64_t kShiftStream = ~std::uint64_t{0};
inline constexpr std::uint64_t kStrataStream = kShiftStream - 1;
inline constexpr std::uint64_t kFirstStratifiedStream = std::uint64_t{1} << 62U;
inline constexpr std::uint64_t kFirstHypercubeStream = std::uint64_t{1} << 63U;

}  // namespace glissade::study
