#include "sweeps/sliding_scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/peg_and_hole.h>
#include <glissade/shapes/screw_thread.h>
#include <glissade/shapes/slide_in_unit.h>
#include <glissade/shapes/spur_gear.h>

#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"

namespace glissade::test_support {
namespace {

using contact::ContactBody;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using std::numbers::pi;

const shapes::ThreadShape kBolt{.turns = 16};
const shapes::ThreadShape kNut{.turns = 4};
constexpr double kNutStartTurns = 1.0;

std::shared_ptr<const ContactBody> body_of(geometry::TriangleMesh mesh) {
  return std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
}

geometry::TriangleMesh flipped(const geometry::TriangleMesh& mesh, const Tessellation& tessellation,
                               std::uint64_t seed) {
  return tessellation.flipped ? geometry::flip_randomly(mesh, seed) : mesh;
}

/// The box in front of planes through the origin with the normals `normals`; the ghost takes poses a second apart.
SlidingScene box_on_planes(const std::string& name, const std::vector<Vector3d>& normals,
                           const Tessellation& tessellation, const std::vector<Isometry3d>& poses_WG) {
  SlidingScene scene;
  scene.name = name;
  const auto sheet = body_of(flipped(geometry::make_plate({0.5, 0.5}, tessellation.triangles), tessellation, 17));
  for (const Vector3d& normal : normals)
    scene.obstacles.push_back({sheet, pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal)), "a plane"});
  scene.part_V = part_of(flipped(geometry::make_box(kBoxSize, std::max(12, tessellation.triangles)), tessellation, 3));
  std::vector<Waypoint> waypoints;
  for (const Isometry3d& X_WG : poses_WG)
    waypoints.push_back({static_cast<int>(1000 * waypoints.size()), X_WG});
  scene.X_WV_start = poses_WG.front();
  scene.ticks = waypoints.back().tick;
  scene.ghost = led_through(std::move(waypoints));
  return scene;
}

}  // namespace

std::function<Isometry3d(int tick)> led_through(std::vector<Waypoint> waypoints) {
  const auto earlier = [](const Waypoint& a, const Waypoint& b) { return a.tick < b.tick; };
  if (waypoints.empty() ||
      std::adjacent_find(waypoints.begin(), waypoints.end(), std::not_fn(earlier)) != waypoints.end())
    throw std::invalid_argument("A ghost is led through at least one waypoint, and their ticks ascend.");
  return [waypoints = std::move(waypoints)](int tick) -> Isometry3d {
    const auto next =
        std::find_if(waypoints.begin(), waypoints.end(), [&](const Waypoint& w) { return w.tick > tick; });
    if (next == waypoints.begin()) return next->X_WG;
    if (next == waypoints.end()) return waypoints.back().X_WG;
    const Waypoint& last = *std::prev(next);
    const double t = static_cast<double>(tick - last.tick) / (next->tick - last.tick);
    if (t == 0.0) return last.X_WG;
    const Vector3d p = (1.0 - t) * last.X_WG.translation() + t * next->X_WG.translation();
    return pose(p, Quaterniond(last.X_WG.linear()).slerp(t, Quaterniond(next->X_WG.linear())));
  };
}

SlidingScene plane_scene(const Tessellation& tessellation) {
  return box_on_planes("plane", {Vector3d::UnitZ()}, tessellation,
                       {pose({-0.1, 0.0, 0.03}), pose({-0.1, 0.0, 0.017}), pose({0.1, 0.05, 0.017}),
                        pose({0.0, 0.0, 0.017}, turn(1.0, {0.0, 0.0, 1.0})), pose({0.0, 0.0, 0.03})});
}

SlidingScene groove_scene(const Tessellation& tessellation) {
  const Vector3d left = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d right = Vector3d(-1.0, 0.0, 1.0).normalized();
  const Quaterniond q = turn(pi / 4, Vector3d::UnitY());
  const Vector3d seat = 0.5 * kBoxSize.z() * left + 0.5 * kBoxSize.x() * right;
  const auto beside = [&](double y, double z) { return pose(seat + Vector3d(0.0, y, z), q); };
  return box_on_planes(
      "groove", {left, right}, tessellation,
      {beside(-0.1, 0.01), beside(-0.1, -0.003), beside(0.1, -0.003), beside(0.0, -0.003), beside(0.0, 0.01)});
}

SlidingScene corner_scene(const Tessellation& tessellation) {
  const Vector3d seat = 0.5 * kBoxSize;
  return box_on_planes("corner", {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, tessellation,
                       {pose(seat + Vector3d(0.01, 0.01, 0.01)), pose(seat - Vector3d(2e-3, 3e-3, 4e-3)),
                        pose(seat - Vector3d(4e-3, 2e-3, 1e-3), turn(0.02, {1.0, 2.0, 3.0})),
                        pose(seat - Vector3d(1e-3, -0.02, 3e-3)), pose(seat + Vector3d(0.01, 0.01, 0.01))});
}

SlidingScene peg_scene(const PegTrial& trial) {
  RandomNumbers random(trial.seed);
  const shapes::PegShape peg;
  const shapes::HoledPlateShape plate{.hole_radius = peg.radius + 52e-6};
  const auto across = [&] {
    const double angle = random.uniform(-pi, pi);
    return Vector3d(std::cos(angle), std::sin(angle), 0.0);
  };
  const Quaterniond yaw = turn(random.uniform(-pi, pi), Vector3d::UnitZ());
  const Vector3d final_offset = trial.offset * across();
  const Quaterniond final_tilt = turn(trial.tilt, across());
  const Vector3d first_direction = across();
  const Vector3d first_offset = random.uniform(0.0, 2e-3) * first_direction;
  const double first_angle = random.uniform(0.0, 2.0) * pi / 180.0;
  const Quaterniond first_tilt = turn(first_angle, across());
  SlidingScene scene;
  scene.name = "peg";
  scene.obstacles.push_back({body_of(shapes::make_holed_plate(plate)), Isometry3d::Identity(), "the plate"});
  scene.part_V = part_of(shapes::make_peg(peg));
  scene.X_WV_start = pose(first_offset + Vector3d(0.0, 0.0, 10e-3), first_tilt * yaw);
  scene.ticks = 2500;
  scene.ghost = led_through({{0, scene.X_WV_start},
                             {1000, pose(final_offset + Vector3d(0.0, 0.0, 1e-3), final_tilt * yaw)},
                             {2000, pose(final_offset - Vector3d(0.0, 0.0, 8e-3), final_tilt * yaw)},
                             {2500, pose(final_offset - Vector3d(0.0, 0.0, 8e-3), final_tilt * yaw)}});
  return scene;
}

SlidingScene gear_scene() {
  const Quaterniond quarter = turn(pi / 2, Vector3d::UnitZ());
  SlidingScene scene;
  scene.name = "gear";
  scene.obstacles.push_back({body_of(shapes::make_gear_base({})), Isometry3d::Identity(), "the base"});
  scene.part_V = part_of(shapes::make_spur_gear({}));
  scene.X_WV_start = pose({0.3e-3, -0.2e-3, 20e-3}, turn(0.02, {1.0, 0.0, 0.0}));
  scene.ticks = 4000;
  scene.ghost = led_through({{0, scene.X_WV_start},
                             {1000, pose({0.2e-3, 0.1e-3, -2e-3})},
                             {2000, pose({0.2e-3, 0.1e-3, -2e-3}, quarter)},
                             {3000, pose({-2e-3, 2e-3, -2e-3}, quarter)},
                             {4000, pose({0.0, 0.0, 20e-3}, quarter)}});
  return scene;
}

SlidingScene nut_scene(double play) {
  constexpr int kTurns = 10;
  SlidingScene scene;
  scene.name = "nut";
  scene.obstacles.push_back({body_of(shapes::make_bolt(kBolt)), Isometry3d::Identity(), "the bolt"});
  scene.part_V = part_of(shapes::make_nut(kNut, play));
  scene.X_WV_start = pose({0.0, 0.0, kNutStartTurns * kBolt.pitch});
  scene.ticks = 1000 * kTurns;
  scene.ghost = [X_WV_start = scene.X_WV_start, ticks = scene.ticks](int tick) -> Isometry3d {
    const double turns = static_cast<double>(std::clamp(tick, 0, ticks)) / 1000.0;
    return pose(X_WV_start.translation(), turn(2.0 * pi * turns, Vector3d::UnitZ()));
  };
  return scene;
}

double nut_advance(const SlidingScene& scene, const Isometry3d& X_WV) {
  return X_WV.translation().z() - scene.X_WV_start.translation().z();
}

double nut_pitch() {
  return kBolt.pitch;
}

SlidingScene bay_scene(bool tongues_give_way) {
  const shapes::SlideInShape shape;
  shapes::BayWithTongues bay = shapes::make_bay_with_tongues(shape);
  SlidingScene scene;
  scene.name = "bay";
  if (tongues_give_way) bay.mesh = geometry::without_triangles(bay.mesh, bay.tongue_triangles);
  scene.obstacles.push_back({body_of(std::move(bay.mesh)), Isometry3d::Identity(), "the bay"});
  scene.part_V = part_of(shapes::make_slide_in_unit(shape));
  scene.X_WV_start = pose({1e-3, -0.19, -1e-3}, turn(0.02, {0.3, 1.0, 0.2}));
  scene.ticks = 4000;
  scene.ghost = led_through({{0, scene.X_WV_start},
                             {500, pose({0.3e-3, -0.17, 0.0})},
                             {2000, pose({0.3e-3, 2e-3, 0.2e-3})},
                             {2200, pose({0.3e-3, 2e-3, 0.2e-3})},
                             {4000, pose({-0.3e-3, -0.19, 0.0})}});
  return scene;
}

SlidingScene clutter_scene(std::uint64_t seed) {
  constexpr double kRoom = 0.25;  // half an edge, metres
  RandomNumbers random(seed);
  SlidingScene scene;
  scene.name = "clutter";
  const auto uniform_box = [&](double low, double high) {
    Vector3d size;
    for (const int axis : {2, 1, 0})
      size[axis] = random.uniform(low, high);
    return size;
  };
  while (scene.obstacles.size() < 60) {
    const Vector3d size = uniform_box(0.02, 0.1);
    const Quaterniond q_WO(random.rotation());
    const Isometry3d X_WO = pose(random.point(kRoom), q_WO);
    if (X_WO.translation().norm() < 0.5 * size.norm() + 0.04) continue;  // the part starts there
    scene.obstacles.push_back({body_of(geometry::make_box(size, 108)), X_WO, "a box"});
  }
  scene.part_V = part_of(geometry::make_box({0.06, 0.04, 0.03}, 108));
  scene.ticks = 4000;
  const Vector3d frequency = uniform_box(0.2, 0.5);  // Hz
  const Vector3d axis = random.direction();
  scene.ghost = [=, ticks = scene.ticks](int tick) -> Isometry3d {
    const double t = 1e-3 * std::clamp(tick, 0, ticks);
    const Vector3d phase = 2.0 * pi * t * frequency;
    return pose(0.8 * kRoom * Vector3d(phase.array().sin()), turn(2.0 * std::sin(phase.sum() / 3.0), axis));
  };
  return scene;
}

SlidingScene housing_scene(int triangles, Fit fit) {
  const Vector3d room(0.2, 0.16, 0.1);
  SlidingScene scene;
  scene.obstacles.push_back({body_of(geometry::make_box(room, triangles)), Isometry3d::Identity(), "the housing"});
  Quaterniond q = Quaterniond::Identity();
  Vector3d half_size;  // extent of the part
  if (fit == Fit::kFlush) {
    const Vector3d size(0.06, 0.05, 0.04);
    scene.part_V = part_of(geometry::make_box(size, triangles));
    half_size = 0.5 * size;
  } else {
    scene.part_V = part_of(geometry::make_torus(0.03, 0.01, triangles));
    q = turn(0.6, {1.0, 0.4, 0.0});
    half_size = Vector3d::Constant(0.04);  // an upper bound
  }
  scene.name = std::string(fit == Fit::kFlush ? "flush" : "light") + "_" + std::to_string(triangles / 1000) + "k";
  // Along the floor and a wall, and through the corner between them; the tilted torus rolls on its rim.
  const Vector3d reach = 0.5 * room - half_size;
  const double press = fit == Fit::kFlush ? 3e-3 : 15e-3;
  const auto at = [&](double x, double y, double z) { return pose({x, y, z}, q); };
  scene.X_WV_start = at(0.0, 0.0, 0.0);
  scene.ticks = 3000;
  scene.ghost = led_through({{0, scene.X_WV_start},
                             {500, at(-0.6 * reach.x(), 0.0, -reach.z() - press)},
                             {1500, at(0.6 * reach.x(), 0.5 * reach.y(), -reach.z() - press)},
                             {2000, at(0.0, reach.y() + press, -reach.z() - press)},
                             {3000, at(-reach.x() - press, reach.y() + press, -reach.z() - press)}});
  return scene;
}

SlidingScene sheets_scene(std::uint64_t seed) {
  RandomNumbers random(seed);
  SlidingScene scene;
  scene.name = "sheets";
  const Tessellation cut{random.integer(2, 400), random.chance(0.5)};
  const Quaterniond q_WO(random.rotation());
  const Isometry3d X_WO = pose(random.point(0.5), q_WO);
  scene.obstacles.push_back(
      {body_of(flipped(geometry::make_plate({0.6, 0.6}, cut.triangles), cut, seed)), X_WO, "the sheet"});
  scene.part_V = part_of(flipped(geometry::make_plate({0.1, 0.06}, random.integer(2, 200)), cut, seed + 1));
  Quaterniond q_OV = turn(random.uniform(-pi, pi), Vector3d::UnitZ());
  if (!random.chance(1.0 / 3.0)) q_OV = Quaterniond(random.rotation());
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double speed = random.uniform(0.5, 5.0);
  constexpr double kDistance = 0.08;  // to either side; more than the part's radius
  scene.X_WV_start = X_WO * pose({0.0, 0.0, side * kDistance}, q_OV);
  const int passing = static_cast<int>(std::ceil(1e3 * 3.0 * kDistance / speed));
  scene.ticks = passing + 20;
  const double tilt = random.uniform(0.0, 0.3);
  const Quaterniond q_through = q_OV * turn(tilt, random.direction());
  const Isometry3d X_through =
      X_WO * pose({random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), -2.0 * side * kDistance}, q_through);
  scene.ghost = led_through({{0, scene.X_WV_start}, {passing, X_through}});
  return scene;
}

double on_the_near_side(const SlidingScene& scene, const Isometry3d& X_WV) {
  const Isometry3d X_OW = scene.obstacles.front().X_WO.inverse();
  const double side = (X_OW * scene.X_WV_start.translation()).z() > 0.0 ? 1.0 : -1.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& x_V : scene.part_V->tree.mesh().vertices)
    least = std::min(least, side * (X_OW * (X_WV * x_V)).z());
  return least;
}

}  // namespace glissade::test_support
