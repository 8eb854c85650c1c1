#include "pipeline/pair_table.h"

#include <algorithm>

#include <glissade/base/assert.h>

namespace glissade::collision {
namespace {

void take_out(std::vector<PairTable::Number>& list, PairTable::Number number) {
  *std::find(list.begin(), list.end(), number) = list.back();
  list.pop_back();
}

}  // namespace

PairTable::Number PairTable::add(const SlotPair& slots) {
  GLISSADE_ASSERT(slots.a != slots.b);
  Number number = 0;
  if (free_.empty()) {
    number = static_cast<Number>(pairs_.size());
    pairs_.emplace_back();
    memories_.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  pairs_[number].slots = slots;
  list_of(slots.a).push_back(number);
  list_of(slots.b).push_back(number);
  return number;
}

PairTable::Number PairTable::number_of(const SlotPair& slots) const {
  GLISSADE_ASSERT(slots.a < of_object_.size());
  const std::vector<Number>& list = of_object_[slots.a];
  const auto found =
      std::find_if(list.begin(), list.end(), [&](Number number) { return pairs_[number].slots == slots; });
  GLISSADE_ASSERT(found != list.end());
  return *found;
}

void PairTable::remove(Number number) {
  GLISSADE_ASSERT(number < pairs_.size() && pairs_[number].slots.a != pairs_[number].slots.b);
  const SlotPair slots = pairs_[number].slots;
  take_out(of_object_[slots.a], number);
  take_out(of_object_[slots.b], number);
  pairs_[number] = {};
  memories_[number] = {};
  free_.push_back(number);
}

std::span<const PairTable::Number> PairTable::of_object(std::uint32_t slot) const {
  if (slot >= of_object_.size()) return {};
  return of_object_[slot];
}

std::vector<PairTable::Number>& PairTable::list_of(std::uint32_t slot) {
  if (slot >= of_object_.size()) of_object_.resize(slot + 1);
  return of_object_[slot];
}

}  // namespace glissade::collision
