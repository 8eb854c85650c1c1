#pragma once

/// Objects that fly about in a box and bounce off its walls, and off each other or not (paper, figure 5). Where each is
/// at any time is known in advance, so that all subjects see the same frames. Lengths in metres, times in seconds; the
/// origin of an object's frame O is the centre of its bounding sphere, that of the world W is a corner of the box.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::bench {

/// Of a frame, as in a haptic loop.
inline constexpr double kFrame_s = 1e-3;

/// From one bounce off another object to the next, an object goes straight but for the walls.
struct Leg {
  double begin_s = 0.0;
  Eigen::Vector3d p_WO;  ///< then
  Eigen::Vector3d v_W;   ///< then
};

/// The way of one object.
struct Flight {
  std::size_t model = 0;  ///< which of the meshes it is
  Eigen::Vector3d low_W;  ///< between here and `high_W` its centre stays
  Eigen::Vector3d high_W;
  std::vector<Leg> legs;  ///< in order; the first begins at time 0
  Eigen::Matrix3d R_WO;   ///< at time 0
  Eigen::Vector3d axis_O;
  double turning = 0.0;  ///< about the axis, rad/s

  bool rests() const { return legs.front().v_W.isZero(0.0) && turning == 0.0; }
  Eigen::Isometry3d pose(double time_s) const;
  /// Where its centre is at a time, and where to.
  Leg leg_from(double time_s) const;
};

/// Objects by their number.
using Scene = std::vector<Flight>;

/// Objects at random places with random models, at 0.3 to 1 m/s and up to 3 rad/s, in a cube of which their bounding
/// spheres fill the share `filled`. `radii`: those of the models. They pass through each other. Equal seeds give equal
/// scenes.
Scene objects_in_box(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed);

/// The same, but no two bounding spheres overlap at the beginning, for which `filled` must not be too much.
Scene objects_apart(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed);

/// Makes two objects that approach each other while their centres come nearer exchange their velocities along the line
/// of the centres when they meet.
void bounce(Flight& a, Flight& b, double time_s);

/// Object 0 bounces about among ten that rest, the same whatever `resting` is; the others, at least ten in all, rest
/// where it never comes.
Scene one_among_resting(std::span<const double> radii, std::size_t resting, double filled, std::uint64_t seed);

/// Somebody has moved an object.
struct MovedObject {
  std::size_t object = 0;
  Eigen::Isometry3d X_WO;
};

/// All objects in frame 0.
std::vector<MovedObject> first_frame(const Scene& scene);
/// Those that do not rest, in any frame.
void moved_objects(const Scene& scene, int frame, std::vector<MovedObject>& moved);

}  // namespace glissade::bench
