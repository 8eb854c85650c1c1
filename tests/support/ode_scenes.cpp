#include "ode_scenes.h"

#include <cmath>
#include <numbers>

#include <glissade/contact/spring.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kWay_ms = 200;
const Vector3d kBox(0.1, 0.06, 0.04);
const OdePart kBoxPart{kBox, 0.0};
const OdePlane kFloor{Vector3d::UnitZ(), 0.0};

OdeScene on_planes(const std::string& name, const std::vector<OdePlane>& planes, const Isometry3d& X_start,
                   const Isometry3d& X_WG) {
  return {name, kBoxPart, planes, {}, X_start, X_WG};
}

OdeScene on_blocks(const std::string& name, const std::vector<OdeBlock>& blocks, const Isometry3d& X_start,
                   const Isometry3d& X_WG) {
  return {name, kBoxPart, {}, blocks, X_start, X_WG};
}

/// Its upper edge lies on the y axis.
OdeBlock ridge() {
  constexpr double kWidth = 0.05;
  return {{kWidth, 0.4, kWidth},
          pose({0.0, 0.0, -kWidth / std::numbers::sqrt2}, turn(0.25 * std::numbers::pi, Vector3d::UnitY())),
          Vector3d::UnitZ()};
}

/// Its upper face is at this height.
OdeBlock table(double x, double y, double top, const Vector3d& size) {
  return {size, pose({x, y, top - 0.5 * size.z()}), Vector3d::UnitZ()};
}

std::vector<OdeScene> scenes_on_planes() {
  const double flat = 0.5 * kBox.z();
  const OdePlane left{Vector3d(1.0, 0.0, 1.0).normalized(), 0.0};
  const OdePlane right{Vector3d(-1.0, 0.0, 1.0).normalized(), 0.0};
  const OdePlane wall_x{Vector3d::UnitX(), 0.0};
  const OdePlane wall_y{Vector3d::UnitY(), 0.0};
  const Quaterniond q_groove = turn(0.25 * std::numbers::pi, Vector3d::UnitY());
  const Vector3d groove = 0.5 * kBox.z() * left.n + 0.5 * kBox.x() * right.n;
  const Vector3d corner = 0.5 * kBox;
  const Quaterniond askew = turn(0.6, Vector3d(2.0, 1.0, 0.3));
  const Quaterniond leaning = turn(0.5, Vector3d::UnitY());
  return {
      on_planes("on a plane", {kFloor}, pose({0.0, 0.0, 0.03}), pose({0.03, 0.02, flat - 3e-3})),
      on_planes("on a plane, with a torque within its foot", {kFloor}, pose({0.0, 0.0, 0.03}),
                pose({0.03, 0.02, flat - 3e-3}, turn(0.02, Vector3d(0.3, 1.0, 0.0)))),
      on_planes("on a plane, tilted onto an edge", {kFloor}, pose({0.0, 0.0, 0.04}),
                pose({0.01, 0.02, flat}, turn(0.15, Vector3d::UnitY()))),
      on_planes("on a plane, on a corner", {kFloor}, pose({0.0, 0.0, 0.08}, askew),
                pose({0.01, 0.02, 0.03}, turn(0.05, Vector3d::UnitX()) * askew)),
      on_planes("in a groove", {left, right}, pose(groove + Vector3d(0.0, 0.0, 0.01), q_groove),
                pose(groove + Vector3d(1e-3, 0.02, -3e-3), q_groove)),
      on_planes("in a groove, with a torque", {left, right}, pose(groove + Vector3d(0.0, 0.0, 0.01), q_groove),
                pose(groove + Vector3d(1e-3, 0.02, -3e-3), turn(0.01, Vector3d(0.2, 0.5, 1.0)) * q_groove)),
      on_planes("in a corner", {wall_x, wall_y, kFloor}, pose(corner + Vector3d::Constant(0.01)),
                pose(corner - Vector3d(2e-3, 3e-3, 4e-3))),
      on_planes("in a corner, with a torque", {wall_x, wall_y, kFloor}, pose(corner + Vector3d::Constant(0.01)),
                pose(corner - Vector3d(2e-3, 3e-3, 4e-3), turn(0.1, Vector3d(1.0, -2.0, 1.5)))),
      on_planes("leaning between floor and wall", {wall_x, kFloor}, pose({0.08, 0.0, 0.06}, leaning),
                pose({0.05, 0.01, 0.04}, leaning)),
  };
}

std::vector<OdeScene> scenes_on_blocks() {
  const double flat = 0.5 * kBox.z();
  const double below = 0.5 * std::hypot(kBox.y(), kBox.z());
  const Quaterniond edge_down = turn_from_to(Vector3d(0.0, kBox.y(), kBox.z()), Vector3d::UnitZ());
  const Vector3d block(0.05, 0.3, 0.05);
  const Vector3d wall(0.05, 0.3, 0.2);
  const auto side = [&](double x, const Vector3d& towards) { return OdeBlock{wall, pose({x, 0.0, 0.0}), towards}; };
  const double slot = 0.5 * (kBox.x() + wall.x()) + 0.2e-3;
  return {
      on_blocks("on a block", {table(0.0, 0.0, 0.0, {0.2, 0.2, 0.1})}, pose({0.0, 0.0, 0.03}),
                pose({0.03, 0.02, flat - 3e-3}, turn(0.3, Vector3d::UnitZ()))),
      on_blocks("over the rim of a block", {table(0.0, 0.0, 0.0, {0.2, 0.2, 0.1})}, pose({0.105, 0.0, 0.03}),
                pose({0.115, 0.01, flat - 2e-3})),
      on_blocks("face over the edge of a block", {ridge()}, pose({0.0, 0.0, 0.03}), pose({0.02, 0.01, flat - 2e-3})),
      on_blocks("edge over the edge of a block", {ridge()}, pose({0.0, 0.0, below + 0.01}, edge_down),
                pose({-0.015, 0.01, below - 3e-3}, edge_down)),
      on_blocks("bridging two blocks of different height",
                {table(-0.06, 0.0, 0.0, block), table(0.06, 0.0, 2e-3, block)}, pose({0.0, 0.0, 0.03}),
                pose({0.0, 0.01, flat - 2e-3})),
      on_blocks("turned in a slot between two walls", {side(-slot, Vector3d::UnitX()), side(slot, -Vector3d::UnitX())},
                pose({0.0, 0.0, 0.0}), pose({1e-3, 0.01, 5e-3}, turn(0.05, Vector3d(0.1, 0.2, 1.0)))),
  };
}

/// An arbitrary rotation, so that spheres lie on facets of their meshes, which those of ODE do not have.
std::vector<OdeScene> scenes_of_spheres() {
  const OdePart sphere{Vector3d::Zero(), 5e-3};
  const double sagitta = sphere.radius * (1.0 - std::cos(0.02));
  const OdePlane left{Vector3d(1.0, 0.0, 1.0).normalized(), 0.0};
  const OdePlane right{Vector3d(-1.0, 0.0, 1.0).normalized(), 0.0};
  const double seat = sphere.radius * std::numbers::sqrt2;
  const Quaterniond q = turn(0.7, Vector3d(1.0, 2.0, 3.0));
  return {
      {"a sphere on a plane", sphere, {kFloor}, {}, pose({0.0, 0.0, 0.006}, q), pose({0.02, 0.0, 0.003}, q), sagitta},
      {"a sphere in a groove",
       sphere,
       {left, right},
       {},
       pose({0.0, 0.0, seat + 1e-3}, q),
       pose({1e-3, 5e-3, seat - 2e-3}, q),
       std::numbers::sqrt2 * sagitta},
  };
}

std::vector<contact::Obstacle> obstacles_of(const OdeScene& scene) {
  std::vector<contact::Obstacle> obstacles;
  for (const OdePlane& plane : scene.planes) {
    const Quaterniond q = turn_from_to(Vector3d::UnitZ(), plane.n);
    obstacles.push_back(obstacle_of(geometry::make_plate({0.5, 0.5}, 2), pose(plane.d * plane.n, q)));
  }
  for (const OdeBlock& block : scene.blocks)
    obstacles.push_back(obstacle_of(geometry::make_box(block.size, 12), block.X_W));
  return obstacles;
}

OdeWorld world_of(const OdeScene& scene, double margin) {
  OdeWorld world;
  for (const OdePlane& plane : scene.planes)
    world.planes.push_back({plane.n, plane.d + margin});
  for (const OdeBlock& block : scene.blocks)
    world.boxes.push_back({block.size, Eigen::Translation3d(margin * block.towards_part) * block.X_W});
  return world;
}

double norm_of(const contact::Wrench& wrench, const contact::CouplingStiffness& K) {
  return std::sqrt(wrench.f.squaredNorm() / K.translational + wrench.t.squaredNorm() / K.rotational);
}

}  // namespace

std::vector<OdeScene> ode_scenes() {
  std::vector<OdeScene> scenes = scenes_on_planes();
  for (const auto& more : {scenes_on_blocks(), scenes_of_spheres()})
    scenes.insert(scenes.end(), more.begin(), more.end());
  return scenes;
}

OdeComparison compare_with_ode(const OdeScene& scene) {
  const auto part = part_of(scene.part.radius > 0.0 ? geometry::make_sphere(scene.part.radius, 50'000)
                                                    : geometry::make_box(scene.part.size, 12));
  contact::Sliding sliding(obstacles_of(scene), part, scene.X_start,
                           {.metaphor = contact::Metaphor::kRubberBandSpring});
  lead(sliding, scene.X_WG, kWay_ms);
  OdeComparison comparison;
  comparison.at_rest = hold_until_rest(sliding) >= 0;
  comparison.contacts = sliding.result().pushing;

  OdeHeldPart ode(world_of(scene, sliding.margin()), scene.part, sliding.stiffness(), scene.X_start);
  for (int i = 1; i <= kWay_ms; ++i)
    ode.step(between(scene.X_start, scene.X_WG, static_cast<double>(i) / kWay_ms));
  const std::optional<int> steps = ode.settle(scene.X_WG);
  comparison.at_rest = comparison.at_rest && steps.has_value();
  comparison.ode_steps = steps.value_or(-1);
  comparison.difference = geometry::displacement_between(ode.X_WV(), sliding.result().X_WV, Vector3d::Zero());

  const geometry::Displacement stretch = geometry::displacement_between(ode.X_WV(), scene.X_WG, Vector3d::Zero());
  const contact::Wrench on_hand = contact::spring_wrench(sliding.stiffness(), stretch);
  const contact::Wrench ours = spring_on_part(sliding);
  const contact::Wrench contacts = ode.contact_wrench();
  const double whole = norm_of(on_hand, sliding.stiffness());
  comparison.force = on_hand.f.norm();
  comparison.torque = on_hand.t.norm();
  comparison.force_difference = (on_hand.f + ours.f).norm() / comparison.force;
  comparison.wrench_difference = norm_of({on_hand.f + ours.f, on_hand.t + ours.t}, sliding.stiffness()) / whole;
  comparison.ode_imbalance = norm_of({contacts.f - on_hand.f, contacts.t - on_hand.t}, sliding.stiffness()) / whole;
  return comparison;
}

}  // namespace glissade::test_support
