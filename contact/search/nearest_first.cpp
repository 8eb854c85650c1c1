#include "search/nearest_first.h"

#include <bit>

namespace glissade::contact {
namespace {

/// Integers in the order of the numbers.
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
}

}  // namespace glissade::contact
