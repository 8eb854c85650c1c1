#pragma once

/// Scenes of sliding contact with the motion of the hand in them, for tests and benchmarks. All is deterministic.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>

#include "scene/contact_scene.h"

namespace glissade::test_support {

/// A part among obstacles and the motion of its ghost.
struct SlidingScene {
  std::string name;
  std::vector<contact::Obstacle> obstacles;
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();  ///< free of collision
  /// X_WG after `tick` milliseconds; tick 0 is the start. Defined for every tick; after the last one the ghost stands
  /// still.
  std::function<Eigen::Isometry3d(int tick)> ghost;
  int ticks = 0;
};

/// The pose of the ghost at a tick. In between, translation and rotation are at constant speed.
struct Waypoint {
  int tick;
  Eigen::Isometry3d X_WG;
};
/// Throws std::invalid_argument unless there is a waypoint and their ticks ascend.
std::function<Eigen::Isometry3d(int tick)> led_through(std::vector<Waypoint> waypoints);

/// The fineness of faces, and whether random triangles are flipped.
struct Tessellation {
  int triangles = 12;
  bool flipped = false;
};

/// A box of 100 × 60 × 40 mm pressed 3 mm deep on a plane, into a groove of two planes at a right angle, or into a
/// corner of three, and moved along: the result is known in closed form.
SlidingScene plane_scene(const Tessellation& tessellation);
SlidingScene groove_scene(const Tessellation& tessellation);
SlidingScene corner_scene(const Tessellation& tessellation);

/// A peg of 4 mm that enters a hole with 52 µm of radial clearance. The origin of the peg is its tip; the upper face of
/// the plate is z = 0. The ghost starts 10 mm above, within 2 mm and 2°, and goes down to a depth of 8 mm, where it is
/// off by `offset` metres across and tilted by `tilt` radians, in directions that depend on the seed.
struct PegTrial {
  double offset = 0.0;
  double tilt = 0.0;
  std::uint64_t seed = 1;
};
SlidingScene peg_scene(const PegTrial& trial);

/// A gear that is put on the post of its base (radial clearance 0.5 mm, less at the corners) 2 mm deep into its seat,
/// turned and dragged there, and taken off.
SlidingScene gear_scene();

/// A nut on an M16 bolt with the play `play` (metres). The ghost turns ten times, a turn each second, and does not move
/// along the axis.
SlidingScene nut_scene(double play = 40e-6);
/// Advance of the nut of that scene along the axis, metres.
double nut_advance(const SlidingScene& scene, const Eigen::Isometry3d& X_WV);
/// Advance per turn without play, metres.
double nut_pitch();

/// A unit that slides into its bay and out again; the ghost goes 2 mm too deep and 0.3 mm beside. The tongues of the
/// bay overlap the seated unit by 0.3 mm and give way to it if `tongues_give_way`. The seat is the identity pose.
SlidingScene bay_scene(bool tongues_give_way = true);

/// A box among 60 boxes at random poses; the ghost moves through all of them.
SlidingScene clutter_scene(std::uint64_t seed);

/// A part of `triangles` triangles in a housing, a box with equally many. Light: a torus, which touches at a few
/// points. Flush: a box, whose faces lie on those of the housing.
enum class Fit { kLight, kFlush };
SlidingScene housing_scene(int triangles, Fit fit);

/// A sheet without thickness whose ghost passes at 0.5 to 5 m/s through another sheet, which is obstacle 0 and lies in
/// the plane z = 0 of its frame. Both have random poses, parallel in one of three seeds, and random tessellations and
/// orientations.
SlidingScene sheets_scene(std::uint64_t seed);
/// The smallest distance of the part's vertices from the plane of the sheet, metres, positive on the side of the start.
double on_the_near_side(const SlidingScene& scene, const Eigen::Isometry3d& X_WV);

/// Names of the scenes above with usual parameters. Making a scene takes up to a second.
const std::vector<std::string>& sliding_scene_names();
/// Throws std::invalid_argument, listing the known names, for any other name.
SlidingScene make_sliding_scene(const std::string& name);

}  // namespace glissade::test_support
