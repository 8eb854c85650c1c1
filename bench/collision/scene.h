#pragma once

/// Objects that fly about in a box and bounce off its walls, and optionally off each other (paper, figure 5). All poses
/// are known in advance, so that all subjects see the same frames. Lengths in metres, times in seconds. The origin of
/// an object's frame O is the centre of its bounding sphere; that of the world W is a corner of the box.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::bench {

/// Duration of a frame, as in a haptic loop.
inline constexpr double kFrame_s = 1e-3;

/// The motion from one bounce off another object to the next: straight, except for reflections at the walls.
struct Leg {
  double begin_s = 0.0;
  Eigen::Vector3d p_WO;  ///< at the beginning
  Eigen::Vector3d v_W;   ///< at the beginning
};

/// The motion of one object.
struct Flight {
  std::size_t model = 0;  ///< number of its mesh
  Eigen::Vector3d low_W;  ///< its centre stays between `low_W` and `high_W`
  Eigen::Vector3d high_W;
  std::vector<Leg> legs;  ///< in order; the first begins at time 0
  Eigen::Matrix3d R_WO;   ///< at time 0
  Eigen::Vector3d axis_O;
  double turning = 0.0;  ///< about the axis, rad/s

  bool rests() const { return legs.front().v_W.isZero(0.0) && turning == 0.0; }
  Eigen::Isometry3d pose(double time_s) const;
  /// A leg that begins at a time: position and velocity of the centre then.
  Leg leg_from(double time_s) const;
};

/// Objects by their number.
using Scene = std::vector<Flight>;

/// Objects with random models and positions, at 0.3 to 1 m/s and up to 3 rad/s. Their bounding spheres fill the
/// fraction `filled` of a cube; `radii` are the radii of the models. The objects pass through each other. Equal seeds
/// give equal scenes.
Scene objects_in_box(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed);

/// The same, but no two bounding spheres overlap at the beginning. Throws std::invalid_argument if `filled` is too
/// large.
Scene objects_apart(std::span<const double> radii, std::size_t count, double filled, std::uint64_t seed);

/// Bounce of two objects that meet: if their centres approach, they exchange the components of their velocities along
/// the line of the centres.
void bounce(Flight& a, Flight& b, double time_s);

/// Object 0 bounces about among ten objects at rest, in the same way for every `resting`, at least 10: the other
/// objects rest where it never comes.
Scene one_among_resting(std::span<const double> radii, std::size_t resting, double filled, std::uint64_t seed);

/// An object with a new pose.
struct MovedObject {
  std::size_t object = 0;
  Eigen::Isometry3d X_WO;
};

/// All objects in frame 0.
std::vector<MovedObject> first_frame(const Scene& scene);
/// All objects that are not at rest, in any frame.
void moved_objects(const Scene& scene, int frame, std::vector<MovedObject>& moved);

}  // namespace glissade::bench
