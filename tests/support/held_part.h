#pragma once

/// What tests of sliding share: bodies made of meshes, how near to a reference they have to come to rest, a ghost that
/// is led and then held, and the sum of the contacts.

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

/// Of the box that most of these tests hold, metres.
inline const Eigen::Vector3d kBoxSize(0.1, 0.06, 0.04);

/// How far a part at rest may be from where a reference has it, and its forces from balance, relatively.
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

/// A sheet of 0.4 m across the x axis.
inline haptics::Obstacle wall(double x) {
  return obstacle_of(geometry::make_plate({0.4, 0.4}, 2),
                     pose({x, 0.0, 0.0}, turn(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())));
}

/// The pose at the fraction `t` of the way from one to another, straight and by the shorter turn.
Eigen::Isometry3d between(const Eigen::Isometry3d& X_from, const Eigen::Isometry3d& X_to, double t);

/// Leads the ghost from where it is to X_WG in so many calls; `see` is shown each answer.
void lead(haptics::SlidingSimulation& sliding, const Eigen::Isometry3d& X_WG, int calls,
          const std::function<void(const haptics::SlidingResult&)>& see = {});

/// Holds the ghost where it is until the part has moved less than a picometre in each of twenty calls. Returns how many
/// calls that took, or -1 if it did not happen within `most_calls`.
int hold_until_rest(haptics::SlidingSimulation& sliding, int most_calls = 2000);

/// What the contacts do to the part, about its reference point: at rest, K ξ* plus this is zero.
haptics::Wrench sum_of_contacts(const haptics::SlidingSimulation& sliding);

/// The spring's force and torque on the part, K ξ*.
haptics::Wrench spring_on_part(const haptics::SlidingSimulation& sliding);

/// How far spring and contacts are from balance, in parts of the spring; both are measured in the norm |F|² = |f|²/k_t
/// + |t|²/k_r, in which a force and a torque that store the same energy weigh the same.
double imbalance(const haptics::SlidingSimulation& sliding);

/// ‖ξ‖_K = √(ξᵀ K ξ).
double length_in(const haptics::CouplingStiffness& stiffness, const geometry::Displacement& d);

}  // namespace glissade::test_support
