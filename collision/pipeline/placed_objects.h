#pragma once

/// Where the objects of a world are, how they have moved, and so for how long two of them that were apart
/// still are.

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/world.h>

namespace glissade::collision {

/// Queries measure in the frame of one of the objects, where lengths differ from those in the world by less than a part
/// in 10^12, the poses being rotations to that: who is further apart in the world than this is further apart than
/// `distance` there.
inline double certain_distance(double distance) {
  return distance * (1.0 + 4e-12);
}

/// That two objects were apart along a direction, which need not be looked into again before they have come nearer
/// along it, or turned. The default says nothing.
struct Separation {
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, from a to b
  double offset = 0.0;  ///< metres: what `PlacedObjects` takes from their places along n_W to get the gap
};

class PlacedObjects {
 public:
  explicit PlacedObjects(std::size_t capacity) : bodies_(capacity), places_(capacity) {}

  /// A new object has come to a slot.
  void place(std::uint32_t slot, const WorldObject& object);

  /// The object of a slot has another pose. Returns how far the centre of its tree has come, in the world.
  Eigen::Vector3d move(std::uint32_t slot, const WorldObject& object);

  /// From where it is now, no point of the object may leave this box about where that point is.
  void give_room(std::uint32_t slot, const Eigen::AlignedBox3d& room);

  /// Whether the object is certainly still within the room it was given.
  bool has_room(std::uint32_t slot) const;

  /// A certain lower bound of the distance of two objects, by their bounding spheres, metres; negative when these
  /// overlap.
  double gap_of_spheres(std::uint32_t slot_a, std::uint32_t slot_b) const;

  /// From the centre of a to that of b, metres, in the world.
  Eigen::Vector3d between(std::uint32_t slot_a, std::uint32_t slot_b) const;

  /// Of two objects that are now, in their frames, apart by `gap` metres at least along n_W, from a to b, whose length
  /// must not be 0.
  Separation separation(std::uint32_t slot_a, std::uint32_t slot_b, const Eigen::Vector3d& n_W, double gap) const;

  /// What is certainly left of the gap, metres; may be negative. Not more than 0 if nothing is known.
  double gap(std::uint32_t slot_a, std::uint32_t slot_b, const Separation& separation) const {
    return along(slot_a, slot_b, separation.n_W) - separation.offset;
  }

 private:
  struct Body {
    Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
    Eigen::Vector3d c_O = Eigen::Vector3d::Zero();  ///< centre of the tree
    double radius = 0.0;                            ///< about it
    double reach = 0.0;                             ///< of the object from the origin of its frame
    Eigen::Vector3d lower_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d upper_W = Eigen::Vector3d::Zero();
  };

  /// No point of the object has moved further from where it would be, had the object moved as c_W has and not turned,
  /// than by the difference of `turned`. Apart from the rest because it is looked at for every pair.
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
