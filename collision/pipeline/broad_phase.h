#pragma once

/// Which objects are near each other: the first stage of neighbor finding (paper §2). Objects are slots with boxes in
/// the world; the broad phase keeps the set of pairs whose boxes may overlap, and says how it changes.
///
/// Boxes are fattened: by a share of their size, and to where they will be soon if they go on as they do. While an
/// object stays in its fat box, nothing needs to be done for it, so a frame costs what has moved, and pairs do not
/// come and go with every tremor. A pair is two fat boxes that overlap.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::collision {

struct SlotPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;  ///< a < b

  auto operator<=>(const SlotPair&) const = default;
};

/// Deterministic: the same calls give the same pairs in the same order.
///
/// Thread-safety: that of a standard container. Allocates as the set of pairs changes.
class BroadPhase {
 public:
  /// Slots are 0 to `capacity` − 1; all are empty. Objects are also near each other when their boxes are not more than
  /// `margin` metres apart. Throws std::invalid_argument when that is negative or not finite, or there is no slot.
  explicit BroadPhase(std::size_t capacity, double margin = 0.0);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  /// Where the object in this slot is from now on, whether there was one or not, and how far it has come in the last
  /// frame. The box must be finite and not empty. Returns how far the box may move along each axis, which it may do
  /// without this being called again: a box about the origin. Cost: O(log n).
  Eigen::AlignedBox3d set(std::uint32_t slot, const Eigen::AlignedBox3d& box,
                          const Eigen::Vector3d& step = Eigen::Vector3d::Zero());

  /// Empties the slot, which must have an object. All its pairs end, also when it is set again before the next
  /// `update`.
  void remove(std::uint32_t slot);

  /// Finds the pairs of what was set since the last call. Cost: O(log n + neighbors) for each of those; nothing for
  /// all others.
  void update();

  /// What the last update has changed, ascending: first `ended` left the set of pairs, then `began` joined it. A pair
  /// is in both when an object was removed and its successor in the slot is near as well.
  std::span<const SlotPair> ended() const { return ended_; }
  std::span<const SlotPair> began() const { return began_; }

  /// As of the last update, the slots that this one is in a pair with, ascending.
  std::span<const std::uint32_t> neighbors(std::uint32_t slot) const { return slots_[slot].neighbors; }
  std::size_t pair_count() const { return pair_count_; }
  /// All pairs, ascending. Cost O(capacity + pairs).
  std::vector<SlotPair> pairs() const;

 private:
  struct Slot {
    Eigen::AlignedBox3d fat_box;  ///< empty: no object
    std::vector<std::uint32_t> neighbors;
    bool is_stale = false;  ///< its pairs are not those of its fat box
  };
  class BoxTree;

  void find_pairs(std::uint32_t slot);
  void join(std::uint32_t slot, std::uint32_t neighbor);
  void part(std::uint32_t slot, std::uint32_t neighbor, std::vector<SlotPair>& list);

  double half_margin_;
  std::vector<Slot> slots_;
  std::unique_ptr<BoxTree> fat_boxes_;
  std::vector<std::uint32_t> stale_;
  std::vector<std::uint32_t> found_;
  std::vector<SlotPair> removed_;  ///< pairs of slots that were removed since the last update
  std::vector<SlotPair> ended_;
  std::vector<SlotPair> began_;
  std::size_t pair_count_ = 0;
};

}  // namespace glissade::collision
