#include "sweeps/torture_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/grid_check.h>

#include "sweeps/sweep_meshes.h"

namespace glissade::test_support {

using contact::ContactBody;
using contact::Obstacle;
using contact::SlidingPart;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using reference::GridCheck;

namespace {

constexpr double kFastest_m_per_ms = 5e-3;

Isometry3d random_pose(const Vector3d& center, double room, RandomNumbers& random) {
  Isometry3d X = Isometry3d::Identity();
  // Parallel to the axes, faces lie flush, and contact is the rule.
  X.linear() = random.chance(0.3) ? random.cube_rotation() : random.rotation();
  X.translation() = center + random.point(room);
  return X;
}

/// Any of the meshes of the sweeps, or an open sheet.
SweepMesh random_torture_mesh(double size, RandomNumbers& random) {
  const Vector3d center = random.chance(0.2) ? random.point(size) : Vector3d::Zero();
  if (!random.chance(0.25)) return random_mesh(size, center, random);
  SweepMesh sheet;
  sheet.mesh =
      geometry::make_plate({size * random.uniform(0.5, 2.0), size * random.uniform(0.5, 2.0)}, random.integer(2, 60));
  sheet.mesh = geometry::flip_randomly(sheet.mesh, static_cast<std::uint64_t>(random.integer(0, 1000)));
  sheet.size = size;
  sheet.center = Vector3d::Zero();
  sheet.description = "sheet, " + std::to_string(sheet.mesh.triangles.size()) + " triangles";
  return sheet;
}

/// Moves the part along a straight line until just before it collides, so that it starts nearer than any margin.
void bring_near(TortureScene& scene, const reference::GridCheck& check, RandomNumbers& random) {
  const geometry::TriangleMesh& part = scene.part_V->tree.mesh();
  const Vector3d towards = scene.room * random.direction();
  const auto moved = [&](double t) {
    Isometry3d X_WV = scene.X_WV_start;
    X_WV.translation() += t * towards;
    return X_WV;
  };
  double free = 0.0;
  double collides = 0.0;
  while (collides < 3.0 && !check.collides(part, moved(collides)))
    free = collides, collides += 0.02;
  if (collides >= 3.0) return;
  const double near = random.power_of_ten(-9.0, -5.0) * std::max(scene.size, 0.01);  // metres
  while ((collides - free) * scene.room > 0.5 * near && collides - free > 1e-15) {
    const double middle = 0.5 * (free + collides);
    (check.collides(part, moved(middle)) ? collides : free) = middle;
  }
  const Isometry3d X_WV = moved(std::max(0.0, free - 0.5 * near / scene.room));
  if (!check.collides(part, X_WV)) scene.X_WV_start = X_WV;
}

void add_obstacles(TortureScene& scene, RandomNumbers& random) {
  const int count = random.integer(1, 5);
  std::shared_ptr<const ContactBody> body;
  for (int i = 0; i < count; ++i) {
    if (body == nullptr || random.chance(0.8)) {
      const double size = std::min(5.0, scene.size * random.power_of_ten(-0.5, 1.0));
      SweepMesh mesh = random_torture_mesh(size, random);
      scene.description += (i == 0 ? " among " : " and ") + mesh.description;
      body = std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(std::move(mesh.mesh)));
      scene.room = std::max(scene.room, 0.7 * size);
    }
    scene.obstacles.push_back({body, random_pose(scene.origin, scene.room, random)});
  }
}

}  // namespace

TortureScene random_torture_scene(RandomNumbers& random) {
  TortureScene scene;
  scene.size = random.power_of_ten(-3.0, std::log10(5.0));
  scene.room = 1.5 * scene.size;
  if (random.chance(0.3)) scene.origin = random.point(10.0);
  SweepMesh mesh = random_torture_mesh(scene.size, random);
  char size_text[40];
  std::snprintf(size_text, sizeof size_text, " of %.3g mm", 1e3 * scene.size);
  scene.description = mesh.description + size_text;
  scene.part_V = std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(std::move(mesh.mesh)));
  add_obstacles(scene, random);
  std::vector<reference::PlacedMesh> placed;
  for (const Obstacle& obstacle : scene.obstacles)
    placed.push_back({std::make_shared<geometry::TriangleMesh>(obstacle.body->tree.mesh()), obstacle.X_WO});
  const reference::GridCheck check(placed);
  do {
    scene.X_WV_start = random_pose(scene.origin, scene.room, random);
    scene.room *= 1.02;  // until the part fits
  } while (check.collides(scene.part_V->tree.mesh(), scene.X_WV_start));
  if (random.chance(0.4)) bring_near(scene, check, random);
  return scene;
}

TortureHand::TortureHand(const TortureScene& scene, RandomNumbers& random)
    : scene_(scene), random_(random), X_WG_(scene.X_WV_start) {}

Vector3d TortureHand::random_place() {
  // Meshes may lie off their own origins.
  return scene_.origin + random_.point(scene_.room);
}

void TortureHand::begin_stretch() {
  constexpr std::array<Motion, 10> kMotions{Motion::kGo,    Motion::kGo,      Motion::kGo,   Motion::kPress,
                                            Motion::kPress, Motion::kTurn,    Motion::kWalk, Motion::kWalk,
                                            Motion::kRest,  Motion::kReleased};
  motion_ = kMotions[static_cast<std::size_t>(random_.integer(0, 9))];
  ticks_left_ = random_.integer(20, 200);
  axis_ = random_.direction();
  speed_ = std::min(kFastest_m_per_ms, scene_.size * random_.power_of_ten(-4.0, 0.0));
  if (random_.chance(0.1)) speed_ = kFastest_m_per_ms;
  turn_speed_ = random_.chance(0.5) ? 0.0 : random_.power_of_ten(-5.0, -1.5);
  target_ = random_place();
  if (motion_ == Motion::kPress) {
    // Into an obstacle: a random corner of one of its triangles.
    const auto number = static_cast<std::size_t>(random_.integer(0, static_cast<int>(scene_.obstacles.size()) - 1));
    const Obstacle& obstacle = scene_.obstacles[number];
    const geometry::TriangleMesh& mesh = obstacle.body->tree.mesh();
    const int triangle = random_.integer(0, static_cast<int>(mesh.triangles.size()) - 1);
    target_ = obstacle.X_WO * mesh.corner(triangle, random_.integer(0, 2));
  }
  if (random_.chance(0.1)) {
    // Somewhere else at once.
    X_WG_ = random_pose(scene_.origin, scene_.room, random_);
    if (random_.chance(0.1)) X_WG_.translation() += 1e3 * random_.direction();
  }
}

const Isometry3d& TortureHand::next() {
  if (ticks_left_-- == 0) begin_stretch();
  Vector3d step = Vector3d::Zero();
  if (motion_ == Motion::kGo || motion_ == Motion::kPress) {
    const Vector3d way = target_ - X_WG_.translation();
    step = way.norm() <= speed_ ? way : Vector3d(speed_ * way.normalized());
  }
  if (motion_ == Motion::kWalk) step = random_.point(speed_);
  double turn = motion_ == Motion::kRest ? 0.0 : turn_speed_;
  if (motion_ == Motion::kTurn) turn = std::max(turn, 0.02);
  X_WG_.translation() += step;
  X_WG_.linear() =
      (Eigen::AngleAxisd(turn, axis_) * Eigen::Quaterniond(X_WG_.linear())).normalized().toRotationMatrix();
  return X_WG_;
}

}  // namespace glissade::test_support
