#pragma once

/// The objects of a scene, their poses, and the enabled pairs of objects: the front end of the collision pipeline
/// (paper §2, §2.3). Any number of threads add, remove and move objects. Meanwhile one thread, the consumer, computes
/// frames. At the beginning of each frame, the consumer takes the changes since the last frame. Coordinate frames: W is
/// the world, O is an object.

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

class ConvexHull;
class TriangleSelection;

/// The permanent identifier of an object. Each object occupies one slot, i.e. a numbered place in the world. A later
/// object in the same slot has another generation.
struct ObjectId {
  std::uint32_t index = 0;       ///< number of the slot
  std::uint32_t generation = 0;  ///< 0: no object

  auto operator<=>(const ObjectId&) const = default;
};

struct ObjectDescription {
  std::shared_ptr<const DopTree> tree;
  std::shared_ptr<const ConvexHull> hull;  ///< hull of the mesh of `tree`; null: no test of hulls
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  int group = 0;  ///< 0 to 63; `World::enable_groups` enables pairs of groups
  /// Selected triangles of the tree; null: no selection. If both objects of a pair have a selection, a pipeline that
  /// looks for closest points (`PairQuery::kClosePairs` in `frame_result.h`) reports only selected triangle pairs
  /// (`PairSelection`).
  std::shared_ptr<const TriangleSelection> selection = nullptr;
};

/// The content of a slot. Default-constructed if the slot is empty.
struct WorldObject {
  ObjectId id;
  std::shared_ptr<const DopTree> tree;
  std::shared_ptr<const ConvexHull> hull;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  int group = 0;
  std::shared_ptr<const TriangleSelection> selection;
};

/// Changes since the last call of `World::take_changes`. Slot numbers are in ascending order.
struct WorldChanges {
  std::vector<std::uint32_t> removed;  ///< slots whose former object was removed
  std::vector<std::uint32_t> added;    ///< slots with a new object; also in `removed` if the former object was removed
  std::vector<std::uint32_t> moved;    ///< slots of earlier objects whose pose may have changed
  bool interest = false;               ///< `is_enabled` may have changed for pairs of earlier objects
};

/// Thread-safety: any thread may edit the world or move objects at any time. One thread is the consumer. A "take" is a
/// call of `take_changes`. An id is stale if it is default-constructed or if its object was removed. Use an id only in
/// the world that returned it.
class GLISSADE_EXPORT World {
 public:
  /// A world for at most `capacity` objects. The memory of the world is about 0.9 kB times `capacity`. Throws
  /// std::invalid_argument unless `capacity` is 1 to 1,000,000.
  explicit World(int capacity = 4096);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  int capacity() const;

  // Editors: any thread may call these functions. Editors may wait for each other, and for the consumer while it copies
  // edits.

  /// Adds an object. Throws std::length_error if the world is full. A removed object still occupies its slot as long as
  /// a thread is inside `move` for this object. Throws std::invalid_argument for:
  /// - a null tree
  /// - a tree with other options than the trees of the objects in this world
  /// - a selection of another tree
  /// - a group outside 0 to 63
  /// - a pose that `move` would reject
  ObjectId add(const ObjectDescription& object);

  /// Removes an object and forgets its disabled pairs. Throws std::invalid_argument for a stale id. The consumer's next
  /// take releases the tree. However, if no take has ever included the object, `remove` itself releases the tree.
  void remove(ObjectId id);

  /// The collision interest matrix. The pipeline compares enabled pairs of objects only. A pair is enabled if its two
  /// groups are enabled for each other and the pair itself is not disabled. Initially, all groups and pairs are
  /// enabled. All four functions are symmetric, and `group_a` may equal `group_b`. `enable_pair` undoes `disable_pair`,
  /// but does not override groups. All four functions throw std::invalid_argument for a group outside 0 to 63 or a
  /// stale id. A take may come between `add` and `disable_pair`. So use groups for objects that must never be compared.
  void enable_groups(int group_a, int group_b);
  void disable_groups(int group_a, int group_b);
  void enable_pair(ObjectId a, ObjectId b);
  void disable_pair(ObjectId a, ObjectId b);

  // Movers: any thread, but only one at a time for each object. These functions are wait-free and allocate nothing.

  /// Sets the pose of the object in the world. `geometry::rigid_pose` corrects the pose to a rotation and translation.
  /// The consumer's next take sees this pose or a newer pose. Returns false and does nothing for a stale id, for a pose
  /// that `rigid_pose` rejects, and if another thread is moving the same object. If another thread removes the object
  /// during the call, `move` may return true although no take ever sees the pose.
  bool move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept;

  // The consumer: only one thread may call these functions.

  /// Applies all edits and poses so far to `objects`, and returns the changes. Waits for at most one edit of an editor,
  /// and never for movers. If a mover replaces a pose while the consumer reads it, the consumer reads the pose again.
  /// Cost O(changes + capacity / 64), plus a copy of the interest matrix if the matrix has changed. Destroys the trees
  /// of removed objects if no other owner holds them. The next call overwrites the result.
  const WorldChanges& take_changes();

  /// The objects by slot, as of the last take; `capacity` entries.
  std::span<const WorldObject> objects() const;

  /// Whether the pair is enabled, as of the last take. Both slots must have objects. Cost O(1).
  bool is_enabled(std::uint32_t slot_a, std::uint32_t slot_b) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::collision

template <>
struct std::hash<glissade::collision::ObjectId> {
  std::size_t operator()(const glissade::collision::ObjectId& id) const noexcept {
    return std::hash<std::uint64_t>{}(std::uint64_t{id.generation} << 32 | id.index);
  }
};
