#pragma once

/// Scenes of sliding contact with the motion of the hand in them, for tests and benchmarks. All is deterministic.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_body.h>

#include "scene/contact_scene.h"

namespace glissade::test_support {

/// A part among obstacles and a ghost that leads it.
struct SlidingScene {
  std::string name;
  std::vector<haptics::Obstacle> obstacles;
  std::shared_ptr<const haptics::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();  ///< free of collision
  /// X_WG after so many milliseconds; that of tick 0 is the start. Any tick may be asked for; after the last one
  /// the ghost stands still.
  std::function<Eigen::Isometry3d(int tick)> ghost;
  int ticks = 0;
};

/// Where the ghost is at a tick; in between it goes straight and turns evenly.
struct Waypoint {
  int tick;
  Eigen::Isometry3d X_WG;
};
/// Throws std::invalid_argument unless there is a waypoint and their ticks ascend.
std::function<Eigen::Isometry3d(int tick)> led_through(std::vector<Waypoint> waypoints);

/// How finely faces are cut, and whether their triangles are turned over at random.
struct Tessellation {
  int triangles = 12;
  bool flipped = false;
};

/// A box of 100 × 60 × 40 mm pressed 3 mm deep on a plane, into a groove of two planes at a right angle, or into a
/// corner of three, and led along: what must come out is known in closed form.
SlidingScene plane_scene(const Tessellation& tessellation);
SlidingScene groove_scene(const Tessellation& tessellation);
SlidingScene corner_scene(const Tessellation& tessellation);

/// A peg of 4 mm led into a hole with 52 µm of radial clearance, its tip being its origin and the plate's upper face
/// z = 0. The ghost comes from 10 mm above, within 2 mm and 2°, and goes down to a depth of 8 mm, off by `offset`
/// metres across and tilted by `tilt` radians, in directions that the seed gives.
struct PegTrial {
  double offset = 0.0;
  double tilt = 0.0;
  std::uint64_t seed = 1;
};
SlidingScene peg_scene(const PegTrial& trial);

/// A gear put on the post of its base (0.5 mm of radial clearance less the corners), 2 mm deep into its seat, turned
/// and dragged there, and taken off.
SlidingScene gear_scene();

/// A nut on a bolt of M16 with this play (metres). The ghost turns ten times, a turn each second, and does not move
/// along the axis.
SlidingScene nut_scene(double play = 40e-6);
/// How far a nut of that scene has come along the axis, metres.
double nut_advance(const SlidingScene& scene, const Eigen::Isometry3d& X_WV);
/// How far it comes in a turn without play, metres.
double nut_pitch();

/// A unit slid into its bay and pulled out again, the ghost going 2 mm too deep and 0.3 mm beside. The tongues of the
/// bay, which overlap the seated unit by 0.3 mm, give way to it if they are to. Home is the identity pose.
SlidingScene bay_scene(bool tongues_give_way = true);

/// A box among 60 boxes that lie about at random; the ghost wanders through all of them.
SlidingScene clutter_scene(std::uint64_t seed);

/// A part of `triangles` triangles in a housing, a box, of as many. Light: a torus, which touches in a few points.
/// Flush: a box, whose faces lie on those of the housing.
enum class Fit { kLight, kFlush };
SlidingScene housing_scene(int triangles, Fit fit);

/// A sheet without thickness led at 0.5 to 5 m/s through another, which is obstacle 0 and the plane z = 0 of its
/// frame. They lie anyhow in the world, are parallel to each other in one seed of three, and are cut and turned over at
/// random.
SlidingScene sheets_scene(std::uint64_t seed);
/// The least distance of a part's vertices from the sheet's plane, metres, positive on the side they started from.
double on_the_near_side(const SlidingScene& scene, const Eigen::Isometry3d& X_WV);

/// The above with usual parameters, by name; making one of them takes up to a second.
const std::vector<std::string>& sliding_scene_names();
/// Throws std::invalid_argument, naming what is known, for any other name.
SlidingScene make_sliding_scene(const std::string& name);

}  // namespace glissade::test_support
