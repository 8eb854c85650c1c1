#include "search/nearest_first.h"

#include <algorithm>
#include <bit>

namespace glissade::haptics {
namespace {

/// Integers in the order of the numbers, which are rounded.
std::uint32_t ordered(double value) {
  constexpr std::uint32_t kSign = 1U << 31U;
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0F);  // no negative zero
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

}  // namespace

void NearestFirst::find_places() {
  keys_.clear();
  keys_.reserve(distances_.size());
  for (const double distance : distances_)
    keys_.push_back(std::uint64_t{ordered(distance)} << 32U | static_cast<std::uint32_t>(keys_.size()));
  sort_keys_(keys_.data(), keys_.size(), hwy::SortAscending());
  // Where distances are equal in single precision, double precision decides.
  for (auto first = keys_.begin(); first != keys_.end();) {
    const auto end = std::find_if(first, keys_.end(), [&](std::uint64_t key) { return key >> 32U != *first >> 32U; });
    if (end - first > 1) {
      std::stable_sort(first, end, [&](std::uint64_t a, std::uint64_t b) {
        return distances_[place_of(a)] < distances_[place_of(b)];
      });
    }
    first = end;
  }
}

}  // namespace glissade::haptics
