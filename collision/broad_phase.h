#pragma once

/// Which objects are near each other: the first stage of neighbour finding (paper §2). Objects are slots with boxes;
/// the broad phase keeps the set of pairs whose boxes may overlap, and says how it changes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::collision {

struct SlotPair {
  std::uint32_t a;
  std::uint32_t b;  ///< a < b
  auto operator<=>(const SlotPair&) const = default;
};

class BroadPhase {
 public:
  /// Slots are 0 to `capacity` − 1. Two boxes are a pair at the latest when they are `margin` metres apart.
  explicit BroadPhase(std::size_t capacity, double margin = 0.0);

  /// Gives the slot a box: a new one, or the one it has moved to.
  void set(std::uint32_t slot, const Eigen::AlignedBox3d& box);
  void remove(std::uint32_t slot);

  /// Brings the set of pairs up to date. After it, and until the next call: `ended`, then `began` make the new set of
  /// the former one. A pair may be in both, when a slot was removed and set again.
  void update();
  std::span<const SlotPair> began() const { return began_; }
  std::span<const SlotPair> ended() const { return ended_; }

  /// The slots this one is a pair with, ascending.
  std::span<const std::uint32_t> neighbours(std::uint32_t slot) const;
  std::size_t pair_count() const;

 private:
  std::vector<SlotPair> began_, ended_;
};

}  // namespace glissade::collision
