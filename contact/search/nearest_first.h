#pragma once

/// Sorts pairs by their distances. Each pair, which is large, is moved only once.

#include <cstdint>
#include <vector>

#include <hwy/contrib/sort/vqsort.h>

namespace glissade::contact {

/// Not thread-safe.
class NearestFirst {
 public:
  /// Sorts in ascending order of the distances (not NaN), which are to have single precision; those equally near stay
  /// in their order. `scratch` may have any content.
  template <typename Pair>
  void sort(std::vector<Pair>& pairs, std::vector<Pair>& scratch) {
    distances_.clear();
    distances_.reserve(pairs.size());
    for (const Pair& pair : pairs)
      distances_.push_back(pair.distance);
    find_places();
    scratch.clear();
    scratch.reserve(pairs.size());
    for (const std::uint64_t key : keys_)
      scratch.push_back(pairs[place_of(key)]);
    pairs.swap(scratch);
  }

 private:
  static std::uint32_t place_of(std::uint64_t key) { return static_cast<std::uint32_t>(key); }
  /// Sets the keys to those of the distances in ascending order.
  void find_places();

  std::vector<double> distances_;
  std::vector<std::uint64_t> keys_;
  hwy::Sorter sort_keys_;
};

}  // namespace glissade::contact
