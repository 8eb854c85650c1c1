#include "pipeline/interest_matrix.h"

#include <stdexcept>
#include <string>

namespace glissade::collision {
namespace {

std::size_t checked(int group) {
  if (group < 0 || group >= InterestMatrix::kGroups) {
    throw std::invalid_argument("the group " + std::to_string(group) + " is not one of 0 to 63");
  }
  return static_cast<std::size_t>(group);
}

}  // namespace

void InterestMatrix::enable_groups(int group_a, int group_b) {
  const std::size_t a = checked(group_a);
  const std::size_t b = checked(group_b);
  rows_[a] |= std::uint64_t{1} << b;
  rows_[b] |= std::uint64_t{1} << a;
}

void InterestMatrix::disable_groups(int group_a, int group_b) {
  const std::size_t a = checked(group_a);
  const std::size_t b = checked(group_b);
  rows_[a] &= ~(std::uint64_t{1} << b);
  rows_[b] &= ~(std::uint64_t{1} << a);
}

bool InterestMatrix::forget(std::uint32_t slot) {
  const auto has_slot = [slot](std::uint64_t pair) { return (pair >> 32) == slot || (pair & 0xffffffffU) == slot; };
  return std::erase_if(disabled_pairs_, has_slot) != 0;
}

}  // namespace glissade::collision
