#pragma once

/// The objects of a scene, their poses, and which pairs of them matter: the front end of the collision pipeline (paper
/// §2, §2.3). Any number of threads add, remove and move objects while one, the consumer, computes; the consumer takes
/// what has changed at the beginning of its next frame, and only that.

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

class ConvexHull;
class TriangleSelection;

/// Names one object for ever: an object that comes to the same slot later has another generation.
struct ObjectId {
  std::uint32_t index = 0;       ///< the slot
  std::uint32_t generation = 0;  ///< 0: no object

  auto operator<=>(const ObjectId&) const = default;
};

struct ObjectDescription {
  std::shared_ptr<const DopTree> tree;
  std::shared_ptr<const ConvexHull> hull;  ///< of the same mesh; null: no filter by hulls
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  int group = 0;  ///< row and column of the interest matrix, 0 to 63
  /// Of the tree. Where both objects have one, `PairQuery::kClosePairs` is after pairs with a selected triangle.
  std::shared_ptr<const TriangleSelection> selection = nullptr;
};

/// What a slot holds. Without an object: the default.
struct WorldObject {
  ObjectId id;
  std::shared_ptr<const DopTree> tree;
  std::shared_ptr<const ConvexHull> hull;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  int group = 0;
  std::shared_ptr<const TriangleSelection> selection;
};

/// What is not as it was at the take before. Slot numbers ascend.
struct WorldChanges {
  std::vector<std::uint32_t> removed;  ///< slots whose former object is gone
  std::vector<std::uint32_t> added;    ///< slots with an object that is new; may have been freed before, see `removed`
  std::vector<std::uint32_t> moved;    ///< slots whose object was there before, and may have another pose
  bool interest = false;               ///< answers of `is_enabled` may differ for pairs that were there before
};

/// Thread-safety: editors and movers may be any threads at any time; the consumer is one thread. A default-constructed
/// id and one of an object that was removed count as stale; those of other worlds must not be used.
class World {
 public:
  /// Room for `capacity` objects; takes about 0.9 kB for each. Throws std::invalid_argument unless 1 to 1,000,000.
  explicit World(int capacity = 4096);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  int capacity() const;

  // Editors: any thread; may block on each other and, for as long as it copies edits, on the consumer.

  /// Throws std::invalid_argument for a null tree, one with other options than those of the objects here, a selection
  /// of another tree, a group beyond 0 to 63, or a pose `move` would refuse; std::length_error when the world is full:
  /// also for as long as a mover is still inside the only slot that is free.
  ObjectId add(const ObjectDescription& object);

  /// Throws std::invalid_argument for a stale id. Pairs of this object need no more be ignored. The tree is let go at
  /// the consumer's next take, or at once if no take has seen the object.
  void remove(ObjectId id);

  /// As in `InterestMatrix`; `disable_pair` and `enable_pair` throw std::invalid_argument for a stale id. A frame may
  /// fall between `add` and `disable_pair`: what must never be compared goes into groups.
  void enable_groups(int group_a, int group_b);
  void disable_groups(int group_a, int group_b);
  void enable_pair(ObjectId a, ObjectId b);
  void disable_pair(ObjectId a, ObjectId b);

  // Movers: any thread, one at a time for each object. Wait-free, and allocates nothing.

  /// The pose of the object in the world, made a rotation and translation by `rigid_pose`. The consumer's next take has
  /// this one or one that was newer. Returns false, and does nothing, for a stale id, while another thread is moving
  /// the same object, and for what is no pose to `rigid_pose`. Returns true for an object that is being removed at the
  /// same time, whose pose nobody will see.
  bool move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept;

  // The consumer: one thread.

  /// Makes `objects` what editors and movers have made of it by now, and says what is different. Blocks on editors for
  /// the length of one edit, never on movers; looks again at a pose that was renewed meanwhile. Cost
  /// O(changes + capacity / 64), and a copy of the interest matrix when that has changed. Objects that were removed are
  /// destroyed here, if nobody else holds them. The result is overwritten by the next call.
  const WorldChanges& take_changes();

  /// By slot, as of the last take; `capacity` of them.
  std::span<const WorldObject> objects() const;

  /// Whether the pair matters, as of the last take. Both slots must have objects. Cost O(1).
  bool is_enabled(std::uint32_t slot_a, std::uint32_t slot_b) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::collision

template <>
struct std::hash<glissade::collision::ObjectId> {
  std::size_t operator()(const glissade::collision::ObjectId& id) const noexcept {
    return std::hash<std::uint64_t>{}(std::uint64_t{id.generation} << 32 | id.index);
  }
};
