#include "sweeps/fit_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/grid_check.h>
#include <glissade/shapes/peg_and_hole.h>
#include <glissade/shapes/screw_thread.h>
#include <glissade/shapes/spur_gear.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using reference::GridCheck;
using std::numbers::pi;

/// A part in its place among others.
struct Mating {
  const char* name;
  TriangleMesh part;
  Isometry3d X_WV;
  std::vector<reference::PlacedMesh> others{};

  void add(TriangleMesh mesh, const Isometry3d& X_WO) {
    others.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), X_WO});
  }
};

Isometry3d turned(double angle) {
  return Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

/// Somewhere on its way along the thread; or the bolt in the nut.
Mating nut_and_bolt(double size, RandomNumbers& random) {
  shapes::ThreadShape thread{.diameter = size,
                             .pitch = size * random.uniform(0.1, 0.2),
                             .turns = random.integer(3, 6),
                             .segments = 12 * random.integer(1, 2)};
  TriangleMesh bolt = shapes::make_bolt(thread);
  thread.turns = random.integer(1, 2);
  const double play = thread.pitch * random.power_of_ten(-2.0, -1.0);
  TriangleMesh nut = shapes::make_nut(thread, play);
  const double t = random.uniform(-1.0, 3.0);
  const Isometry3d X_BoltNut = at(0.0, 0.0, thread.pitch * t) * turned(2.0 * pi * t);
  if (random.chance(0.5)) {
    Mating fit{"nut on its bolt", std::move(nut), X_BoltNut};
    fit.add(std::move(bolt), Isometry3d::Identity());
    return fit;
  }
  Mating fit{"bolt in its nut", std::move(bolt), X_BoltNut.inverse(Eigen::Isometry)};
  fit.add(std::move(nut), Isometry3d::Identity());
  return fit;
}

/// On its post, beside a gear that stands still.
Mating gears(double size, RandomNumbers& random) {
  shapes::GearShape gear{.teeth = random.integer(10, 16)};
  gear.module = size / gear.teeth;
  gear.width = 0.4 * size;
  gear.bore_radius = 0.25 * size;
  gear.flank_points = random.integer(2, 4);
  shapes::GearBaseShape base{.size = 1.5 * size,
                             .thickness = 0.2 * size,
                             .post_radius = gear.bore_radius,
                             .post_height = 0.6 * size,
                             .chamfer = 0.02 * size,
                             .segments = 16};
  base.post_radius *= std::cos(pi / base.segments) * (1.0 - random.power_of_ten(-3.0, -1.5));
  const double height = size * random.power_of_ten(-4.0, -1.0);
  Mating fit{"gear on its post", shapes::make_spur_gear(gear), at(0.0, 0.0, height) * turned(random.uniform(0.0, pi))};
  fit.add(shapes::make_gear_base(base), Isometry3d::Identity());
  const double away = size * (1.0 + random.power_of_ten(-2.5, -1.0));  // the sum of both pitch radii, and some play
  fit.add(fit.part, at(away, 0.0, height) * turned(random.uniform(0.0, pi)));
  return fit;
}

Mating peg_in_hole(double size, RandomNumbers& random) {
  const int segments = 8 * random.integer(1, 3);
  const shapes::PegShape peg{.radius = 0.3 * size, .length = 2.0 * size, .chamfer = 0.05 * size, .segments = segments};
  const double play = random.power_of_ten(-3.5, -1.5);
  const shapes::HoledPlateShape plate{.hole_radius = peg.radius * (1.0 + play) / std::cos(pi / segments),
                                      .size = 2.0 * size,
                                      .thickness = size,
                                      .segments = segments};
  Mating fit{"peg in its hole", shapes::make_peg(peg), at(0.0, 0.0, -size * random.uniform(0.1, 2.0))};
  fit.add(shapes::make_holed_plate(plate), Isometry3d::Identity());
  return fit;
}

Mating sleeve_on_rod(double size, RandomNumbers& random) {
  const int segments = 8 * random.integer(1, 3);
  const shapes::PegShape rod{.radius = 0.3 * size, .length = 3.0 * size, .chamfer = 0.05 * size, .segments = segments};
  const double radius = rod.radius * (1.0 + random.power_of_ten(-3.5, -1.5)) / std::cos(pi / segments);
  Mating fit{"sleeve on its rod", geometry::make_tube(radius / std::cos(pi / 12), size, 200),
             at(0.0, 0.0, size * random.uniform(0.0, 3.0)) * turned(random.uniform(0.0, pi))};
  fit.add(shapes::make_peg(rod), Isometry3d::Identity());
  return fit;
}

/// The socket is a cup that goes round more than half of the ball, an open sheet.
Mating ball_in_socket(double size, RandomNumbers& random) {
  const double radius = 0.5 * size;
  constexpr int kSegments = 20;
  const double facets = std::cos(pi / kSegments) * std::cos(0.5 * pi / kSegments);
  const double play = random.power_of_ten(-3.0, -1.5);
  const double rim = random.uniform(-0.5, 0.7);  // rad above the equator
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= kSegments / 2; ++i) {
    const double angle = -0.5 * pi + (rim + 0.5 * pi) * i / (0.5 * kSegments);
    profile.emplace_back(i == 0 ? 0.0 : radius * (1.0 + play) / facets * std::cos(angle),
                         radius * (1.0 + play) / facets * std::sin(angle));
  }
  Mating fit{"ball in its socket", geometry::make_sphere(radius, random.integer(100, 300)),
             Isometry3d(random.rotation())};
  fit.add(geometry::make_revolution(profile, false, kSegments), Isometry3d::Identity());
  return fit;
}

Mating random_fit(double size, RandomNumbers& random) {
  switch (random.integer(0, 5)) {
    case 0:
    case 1:
      return nut_and_bolt(size, random);
    case 2:
      return gears(size, random);
    case 3:
      return peg_in_hole(size, random);
    case 4:
      return sleeve_on_rod(size, random);
    default:
      return ball_in_socket(size, random);
  }
}

}  // namespace

TortureScene random_fit_scene(RandomNumbers& random) {
  TortureScene scene;
  scene.size = random.power_of_ten(-2.3, -0.3);
  const Isometry3d X_WFit = Eigen::Translation3d(random.chance(0.3) ? random.point(10.0) : Vector3d::Zero()) *
                            Isometry3d(random.chance(0.3) ? random.cube_rotation() : random.rotation());
  for (;;) {
    Mating fit = random_fit(scene.size, random);
    for (reference::PlacedMesh& other : fit.others)
      other.X_WB = X_WFit * other.X_WB;
    scene.X_WV_start = X_WFit * fit.X_WV;
    // Gears are turned as it comes, and the corners of some facets meet.
    if (GridCheck(fit.others).collides(fit.part, scene.X_WV_start)) continue;
    scene.origin = scene.X_WV_start.translation();
    scene.room = 1.5 * scene.size;
    for (const reference::PlacedMesh& other : fit.others)
      scene.obstacles.push_back(
          {std::make_shared<contact::ContactBody>(std::make_shared<TriangleMesh>(*other.mesh)), other.X_WB});
    scene.part_V = std::make_shared<contact::SlidingPart>(std::make_shared<TriangleMesh>(std::move(fit.part)));
    char text[60];
    std::snprintf(text, sizeof text, "%s, %.3g mm", fit.name, 1e3 * scene.size);
    scene.description = text;
    return scene;
  }
}

}  // namespace glissade::test_support
