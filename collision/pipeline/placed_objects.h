#pragma once

/// The positions of the objects of a world and bounds of their motion. They determine for how long two objects that
/// were apart are still apart.

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/world.h>

namespace glissade::collision {

/// Objects farther apart than this in the world are farther apart than `distance` in either object's frame, where
/// queries measure. World poses are rotations up to a defect, so lengths in an object's frame differ from those in the
/// world by less than a part in 10^12.
inline double certain_distance(double distance) {
  return distance * (1.0 + 4e-12);
}

/// A direction along which two objects were apart. They need no new test until they have approached along it or turned
/// by a certain amount. The default means: nothing is known.
struct Separation {
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, from a to b
  double offset = 0.0;                            ///< metres; `PlacedObjects::gap` subtracts it
};

class PlacedObjects {
 public:
  explicit PlacedObjects(std::size_t capacity) : bodies_(capacity), places_(capacity) {}

  /// Registers a new object in a slot.
  void place(std::uint32_t slot, const WorldObject& object);

  /// Registers a new pose of the object in a slot. Returns the step of the centre of its tree, in the world.
  Eigen::Vector3d move(std::uint32_t slot, const WorldObject& object);

  /// Limits the motion of the object from its present pose: no point of it may leave `room`, a box about the present
  /// position of that point.
  void give_room(std::uint32_t slot, const Eigen::AlignedBox3d& room);

  /// Whether the object is certainly still within its room.
  bool has_room(std::uint32_t slot) const;

  /// A certain lower bound of the distance of two objects by their bounding spheres, metres; negative if these overlap.
  double gap_of_spheres(std::uint32_t slot_a, std::uint32_t slot_b) const;

  /// The vector from the centre of a to that of b, metres, in the world.
  Eigen::Vector3d between(std::uint32_t slot_a, std::uint32_t slot_b) const;

  /// The separation of two objects that are now, measured in their own frames, at least `gap` metres apart along n_W.
  /// n_W points from a to b; its length must not be 0.
  Separation separation(std::uint32_t slot_a, std::uint32_t slot_b, const Eigen::Vector3d& n_W, double gap) const;

  /// A certain lower bound of the gap that is left, metres; may be negative. At most 0 if nothing is known.
  double gap(std::uint32_t slot_a, std::uint32_t slot_b, const Separation& separation) const {
    return along(slot_a, slot_b, separation.n_W) - separation.offset;
  }

 private:
  struct Body {
    Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
    Eigen::Vector3d c_O = Eigen::Vector3d::Zero();  ///< centre of the tree
    double radius = 0.0;                            ///< of the tree, about c_O
    double reach = 0.0;  ///< largest distance of a point of the object from the origin of its frame
    Eigen::Vector3d lower_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d upper_W = Eigen::Vector3d::Zero();
  };

  /// Position of the tree's centre, and a bound that accumulates the effect of rotations: between two moments, no point
  /// of the object has moved relative to the centre, in axes of the world, by more than the increase of `turned`
  /// (metres). Separate from `Body` because it is read for every pair.
  struct Place {
    Eigen::Vector3d c_W = Eigen::Vector3d::Zero();
    double turned = 0.0;
  };

  double along(std::uint32_t slot_a, std::uint32_t slot_b, const Eigen::Vector3d& n_W) const {
    const Place& a = places_[slot_a];
    const Place& b = places_[slot_b];
    return n_W.dot(b.c_W - a.c_W) - (a.turned + b.turned);
  }

  std::vector<Body> bodies_;
  std::vector<Place> places_;
};

}  // namespace glissade::collision
