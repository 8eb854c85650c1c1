#pragma once

/// Private: where the objects of a world are and how far each has come: the clock by which gaps expire.

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/world.h>

namespace glissade::collision {

class PlacedObjects {
 public:
  explicit PlacedObjects(std::size_t capacity) : objects_(capacity), travels_(capacity, 0.0) {}

  /// A new object has come to a slot.
  void place(std::uint32_t slot, const WorldObject& object);

  /// The object of a slot has another pose.
  void move(std::uint32_t slot, const WorldObject& object);

  /// The sum of the motions of two objects, metres: their distance has not changed by more than the difference
  /// of this.
  double motion(std::uint32_t slot_a, std::uint32_t slot_b) const { return travels_[slot_a] + travels_[slot_b]; }

  /// A certain lower bound of the distance of two objects, by their bounding spheres, metres; negative when these
  /// overlap.
  double gap_of_spheres(std::uint32_t slot_a, std::uint32_t slot_b) const;

  /// What `motion` may become while two objects stay apart whose gap is now, in their frames, at least `gap` metres.
  double apart_until(std::uint32_t slot_a, std::uint32_t slot_b, double gap) const;

 private:
  struct Placed {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    Eigen::Vector3d c_W = Eigen::Vector3d::Zero();  ///< centre of the tree
    double radius = 0.0;                            ///< about it
    double reach = 0.0;                             ///< of the object from the origin of its frame
  };

  std::vector<Placed> objects_;
  /// Metres: no point of the object has moved further, all told. Apart from the rest because it is looked at for every
  /// pair.
  std::vector<double> travels_;
};

}  // namespace glissade::collision
