#pragma once

/// The collision interest matrix (paper §2): the pairs of objects that are enabled. Objects belong to groups. A pair of
/// objects is enabled if its two groups are enabled for each other and the pair itself is not disabled; parts that are
/// attached to each other are disabled pairs. A `World` has one.

#include <array>
#include <cstdint>
#include <unordered_set>

#include <glissade/base/assert.h>

namespace glissade::collision {

/// Objects are identified by slot numbers of the caller's choice. All functions are symmetric. At first every pair is
/// enabled.
///
/// Thread-safety: that of a standard container.
class InterestMatrix {
 public:
  static constexpr int kGroups = 64;

  InterestMatrix() { rows_.fill(~std::uint64_t{0}); }

  /// Enables or disables the pairs of an object of one group with an object of the other; `group_a` may equal
  /// `group_b`. Groups are 0 to 63. Throws std::invalid_argument for any other.
  void enable_groups(int group_a, int group_b);
  void disable_groups(int group_a, int group_b);

  /// Disables the pair of these two objects, whatever their groups. `enable_pair` undoes that; it does not override
  /// groups.
  void disable_pair(std::uint32_t slot_a, std::uint32_t slot_b) { disabled_pairs_.insert(key(slot_a, slot_b)); }
  void enable_pair(std::uint32_t slot_a, std::uint32_t slot_b) { disabled_pairs_.erase(key(slot_a, slot_b)); }
  /// Forgets the disabled pairs of an object that was removed. Returns whether there were any. Cost O(disabled pairs).
  bool forget(std::uint32_t slot);

  /// Whether the pair is enabled. The pair of an object with itself never is. Groups must be 0 to 63. Cost O(1).
  bool is_enabled(std::uint32_t slot_a, int group_a, std::uint32_t slot_b, int group_b) const {
    GLISSADE_ASSERT(group_a >= 0 && group_a < kGroups && group_b >= 0 && group_b < kGroups);
    return slot_a != slot_b && (rows_[static_cast<std::size_t>(group_a)] >> group_b & 1U) != 0 &&
           (disabled_pairs_.empty() || !disabled_pairs_.contains(key(slot_a, slot_b)));
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
  }

  std::array<std::uint64_t, kGroups> rows_;  ///< bit h of row g: the groups g and h are enabled for each other
  std::unordered_set<std::uint64_t> disabled_pairs_;
};

}  // namespace glissade::collision
