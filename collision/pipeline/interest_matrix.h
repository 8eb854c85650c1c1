#pragma once

/// Which pairs of objects matter (paper §2): the collision interest matrix. Objects are in groups; two groups are of
/// interest to each other or not, and single pairs of objects can be ignored beside that, as parts that are attached
/// to each other. A `World` has one; take one alone to filter pairs that come from elsewhere.

#include <array>
#include <cstdint>
#include <unordered_set>

#include <glissade/base/assert.h>

namespace glissade::collision {

/// Objects are known by slot numbers, of the caller's choice. All is symmetric. In the beginning every pair is of
/// interest.
///
/// Thread-safety: that of a standard container.
class InterestMatrix {
 public:
  static constexpr int kGroups = 64;

  InterestMatrix() { rows_.fill(~std::uint64_t{0}); }

  /// Objects of these two groups are of interest to each other; `group_a` may be `group_b`. Groups are 0 to 63.
  /// Throws std::invalid_argument for any other.
  void enable_groups(int group_a, int group_b);
  void disable_groups(int group_a, int group_b);

  /// These two objects are of no interest to each other, whatever their groups; `enable_pair` takes that back.
  void disable_pair(std::uint32_t slot_a, std::uint32_t slot_b) { ignored_.insert(key(slot_a, slot_b)); }
  void enable_pair(std::uint32_t slot_a, std::uint32_t slot_b) { ignored_.erase(key(slot_a, slot_b)); }
  /// Attends to every pair of this object again, because it is no more; returns whether any was ignored. Cost O(pairs
  /// that are ignored).
  bool forget(std::uint32_t slot);

  /// Whether the pair is of interest. An object is of no interest to itself. Groups must be 0 to 63. Cost O(1).
  bool is_enabled(std::uint32_t slot_a, int group_a, std::uint32_t slot_b, int group_b) const {
    GLISSADE_ASSERT(group_a >= 0 && group_a < kGroups && group_b >= 0 && group_b < kGroups);
    return slot_a != slot_b && (rows_[static_cast<std::size_t>(group_a)] >> group_b & 1U) != 0 &&
           (ignored_.empty() || !ignored_.contains(key(slot_a, slot_b)));
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
  }

  std::array<std::uint64_t, kGroups> rows_;  ///< bit h of row g: the groups g and h are of interest to each other
  std::unordered_set<std::uint64_t> ignored_;
};

}  // namespace glissade::collision
