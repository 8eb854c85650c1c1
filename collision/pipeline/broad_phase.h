#pragma once

/// The broad phase: finds the objects that are near each other, the first stage of neighbor finding (paper §2). Each
/// object is a slot with an axis-aligned bounding box in the world. The broad phase keeps the set of pairs whose boxes
/// may overlap and reports its changes.
///
/// Boxes are fattened by a fraction of their size, and extended to where they will soon be if their motion continues.
/// While an object stays in its fat box it costs nothing, so the cost of a frame follows the motion, and pairs do not
/// come and go with every tremor. A pair is two objects whose fat boxes overlap.

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
  /// Creates the slots 0 to `capacity` − 1, all empty. Boxes that are at most `margin` metres apart count as near, too.
  /// Throws std::invalid_argument if `margin` is negative or not finite, or if `capacity` is 0.
  explicit BroadPhase(std::size_t capacity, double margin = 0.0);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  /// Sets the box of the object in this slot, whether the slot was empty or not, and the object's step in the last
  /// frame. The box must be finite and not empty. Returns the room to move: a box about the origin that holds the
  /// translations of the box for which `set` need not be called again. Cost O(log n).
  Eigen::AlignedBox3d set(std::uint32_t slot, const Eigen::AlignedBox3d& box,
                          const Eigen::Vector3d& step = Eigen::Vector3d::Zero());

  /// Empties the slot, which must have an object. All its pairs end, even if it is set again before the next `update`.
  void remove(std::uint32_t slot);

  /// Finds the pairs of the objects that were set since the last call. Cost: O(log n + neighbors) for each of these,
  /// nothing for all others.
  void update();

  /// Changes of the last update, ascending: first the pairs that left the set, then those that joined it. A pair is in
  /// both if an object was removed and its successor in the slot is near as well.
  std::span<const SlotPair> ended() const { return ended_; }
  std::span<const SlotPair> began() const { return began_; }

  /// The slots paired with this one as of the last update, ascending.
  std::span<const std::uint32_t> neighbors(std::uint32_t slot) const { return slots_[slot].neighbors; }
  std::size_t pair_count() const { return pair_count_; }
  /// All pairs, ascending. Cost O(capacity + pairs).
  std::vector<SlotPair> pairs() const;

 private:
  struct Slot {
    Eigen::AlignedBox3d fat_box;  ///< empty: no object
    std::vector<std::uint32_t> neighbors;
    bool is_stale = false;  ///< its pairs do not match its fat box yet
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
