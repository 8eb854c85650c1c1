#pragma once

/// The tracked pairs, by number and by object.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/base/assert.h>

#include "pipeline/tracked_pair.h"

namespace glissade::collision {

/// Not thread-safe, but several threads may work on different pairs at once.
class PairTable {
 public:
  using Number = std::uint32_t;

  /// Begins to track a pair of different objects, which must not be tracked yet. Returns its number. Cost O(1).
  Number add(const SlotPair& slots);

  /// The number of a pair of objects, which must be tracked. Cost O(pairs of one object).
  Number number_of(const SlotPair& slots) const;

  /// Ceases to track a pair, which must be tracked. Its number may be reused. Cost O(pairs of either object).
  void remove(Number number);

  TrackedPair& operator[](Number number) {
    GLISSADE_ASSERT(number < pairs_.size());
    return pairs_[number];
  }
  const TrackedPair& operator[](Number number) const {
    GLISSADE_ASSERT(number < pairs_.size());
    return pairs_[number];
  }
  PairMemory& memory(Number number) {
    GLISSADE_ASSERT(number < memories_.size());
    return memories_[number];
  }

  /// Number of tracked pairs.
  std::size_t size() const { return pairs_.size() - free_.size(); }

  /// Calls visit(number) for each tracked pair, in no particular order.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (Number number = 0; number < pairs_.size(); ++number) {
      if (pairs_[number].slots.a != pairs_[number].slots.b) visit(number);
    }
  }

  /// The numbers of all pairs that an object takes part in, in no particular order.
  std::span<const Number> of_object(std::uint32_t slot) const;

 private:
  std::vector<Number>& list_of(std::uint32_t slot);

  std::vector<TrackedPair> pairs_;
  std::vector<PairMemory> memories_;
  std::vector<Number> free_;
  std::vector<std::vector<Number>> of_object_;
};

}  // namespace glissade::collision
