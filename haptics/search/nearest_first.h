#pragma once

/// Sorts pairs by their distances. Each pair, which is large, is moved only once.

#include <cstdint>
#include <vector>

#include <hwy/contrib/sort/vqsort.h>

namespace glissade::haptics {

/// Not thread-safe.
class NearestFirst {
 public:
  /// Sorts in ascending order of the distances (not NaN); those equally near stay in their order. `scratch` may have
  /// any content.
  template <typename Pair>
  void sort(std::vector<Pair>& pairs, std::vector<Pair>& scratch) {
    distances_.clear();
    for (const Pair& pair : pairs)
      distances_.push_back(pair.distance);
    find_places();
    scratch.clear();
    for (const std::uint64_t key : keys_)
      scratch.push_back(pairs[static_cast<std::uint32_t>(key)]);
    pairs.swap(scratch);
  }

 private:
  /// Sets the lower halves of the keys to the places of the distances in ascending order.
  void find_places();

  std::vector<double> distances_;
  std::vector<std::uint64_t> keys_;
  hwy::Sorter sort_keys_;
};

}  // namespace glissade::haptics
