#pragma once

/// Shared by tests of sliding: bodies of meshes, tolerances of rest poses, motions of the ghost, and the sum of the
/// contact forces.

#include <functional>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding.h>

#include "poses.h"

namespace glissade::test_support {

/// Size of the box in most of these tests, metres.
inline const Eigen::Vector3d kBoxSize(0.1, 0.06, 0.04);

/// Greatest deviation of a part at rest from the reference pose, and relative imbalance of its forces.
constexpr double kRestPosition_m = 0.5e-6;
constexpr double kRestRotation_rad = 0.02e-3 * std::numbers::pi / 180.0;
constexpr double kRestBalance = 1e-6;

inline std::shared_ptr<const haptics::SlidingPart> part_of(geometry::TriangleMesh mesh) {
  return std::make_shared<const haptics::SlidingPart>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
}

inline haptics::Obstacle obstacle_of(geometry::TriangleMesh mesh,
                                     const Eigen::Isometry3d& X_WO = Eigen::Isometry3d::Identity()) {
  return {std::make_shared<const haptics::ContactBody>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh))),
          X_WO};
}

inline std::shared_ptr<const haptics::SlidingPart> cube(double edge) {
  return part_of(geometry::make_box({edge, edge, edge}, 12));
}

/// A square sheet of 0.4 m, normal to the x axis.
inline haptics::Obstacle wall(double x) {
  return obstacle_of(geometry::make_plate({0.4, 0.4}, 2),
                     pose({x, 0.0, 0.0}, turn(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())));
}

/// The pose at the fraction `t` of the motion from one pose to another: straight, and by the shorter rotation.
Eigen::Isometry3d between(const Eigen::Isometry3d& X_from, const Eigen::Isometry3d& X_to, double t);

/// Moves the ghost from its pose to X_WG in `calls` calls; `see` receives each result.
void lead(haptics::SlidingSimulation& sliding, const Eigen::Isometry3d& X_WG, int calls,
          const std::function<void(const haptics::SlidingResult&)>& see = {});

/// Holds the ghost at its pose until the part has moved less than a picometre in each of twenty calls. Returns the
/// number of calls, or -1 if the part did not come to rest within `most_calls`.
int hold_until_rest(haptics::SlidingSimulation& sliding, int most_calls = 2000);

/// Wrench of all contacts on the part about its reference point: at rest, its sum with K ξ* is zero.
haptics::Wrench sum_of_contacts(const haptics::SlidingSimulation& sliding);

/// Wrench of the spring on the part, K ξ*.
haptics::Wrench spring_on_part(const haptics::SlidingSimulation& sliding);

/// Sum of the wrenches of spring and contacts, relative to that of the spring, in the norm |F|² = |f|²/k_t + |t|²/k_r.
/// In this norm, a force and a torque that store the same energy are equal.
double imbalance(const haptics::SlidingSimulation& sliding);

/// ‖ξ‖_K = √(ξᵀ K ξ).
double length_in(const haptics::CouplingStiffness& stiffness, const geometry::Displacement& d);

}  // namespace glissade::test_support
