#pragma once

/// Shared by tests of sliding: bodies of meshes, tolerances of rest poses, motions of the ghost, and the sum of the
/// contact forces.

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "poses.h"

namespace glissade::test_support {

/// Size of the box in most of these tests, metres.
inline const Eigen::Vector3d kBoxSize(0.1, 0.06, 0.04);

/// Greatest deviation of a part at rest from the reference pose, and relative imbalance of its forces.
constexpr double kRestPosition_m = 0.5e-6;
constexpr double kRestRotation_rad = 0.02e-3 * std::numbers::pi / 180.0;
constexpr double kRestBalance = 1e-6;

inline std::shared_ptr<const contact::SlidingPart> part_of(geometry::TriangleMesh mesh) {
  return std::make_shared<const contact::SlidingPart>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
}

inline contact::Obstacle obstacle_of(geometry::TriangleMesh mesh,
                                     const Eigen::Isometry3d& X_WO = Eigen::Isometry3d::Identity()) {
  return {std::make_shared<const contact::ContactBody>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh))),
          X_WO};
}

inline std::shared_ptr<const contact::SlidingPart> cube(double edge) {
  return part_of(geometry::make_box({edge, edge, edge}, 12));
}

/// A square sheet of 0.4 m, normal to the x axis.
inline contact::Obstacle wall(double x) {
  return obstacle_of(geometry::make_plate({0.4, 0.4}, 2),
                     pose({x, 0.0, 0.0}, turn(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())));
}

/// The pose at the fraction `t` of the motion from one pose to another: straight, and by the shorter rotation.
Eigen::Isometry3d between(const Eigen::Isometry3d& X_from, const Eigen::Isometry3d& X_to, double t);

/// Moves the ghost from its pose to X_WG in `calls` calls; `see` receives each result.
template <typename Simulation>
void lead(Simulation& sliding, const Eigen::Isometry3d& X_WG, int calls,
          const std::function<void(const contact::SlidingResult&)>& see = {}) {
  const Eigen::Isometry3d X_WG_from = sliding.result().X_WG;
  for (int i = 1; i <= calls; ++i) {
    // The last pose is X_WG to the bit.
    const contact::SlidingResult& result =
        sliding.advance(i == calls ? X_WG : between(X_WG_from, X_WG, static_cast<double>(i) / calls));
    if (see) see(result);
  }
}

/// Holds the ghost at its pose until the part has moved less than a picometre in each of twenty calls. Returns the
/// number of calls, or -1 if the part did not come to rest within `most_calls`.
template <typename Simulation>
int hold_until_rest(Simulation& sliding, int most_calls = 2000) {
  const Eigen::Isometry3d X_WG = sliding.result().X_WG;
  int still = 0;
  for (int call = 1; call <= most_calls; ++call) {
    const Eigen::Isometry3d X_WV = sliding.result().X_WV;
    sliding.advance(X_WG);
    const geometry::Displacement moved =
        geometry::displacement_between(X_WV, sliding.result().X_WV, sliding.part().p_Vref());
    still = geometry::motion_bound(moved, sliding.part().radius()) < 1e-12 ? still + 1 : 0;
    if (still == 20) return call;
  }
  return -1;
}

/// Wrench of all contacts on the part about its reference point: at rest, its sum with K ξ* is zero.
template <typename Simulation>
contact::Wrench sum_of_contacts(const Simulation& sliding) {
  const contact::SlidingResult& result = sliding.result();
  const Eigen::Vector3d p_Wref = result.X_WV_of_contacts * sliding.part().p_Vref();
  contact::Wrench sum;
  for (const contact::Contact& contact : result.contacts) {
    const Eigen::Vector3d f = contact.force * contact.n_W + contact.friction_W;
    sum.f += f;
    sum.t += (contact.p_W - p_Wref).cross(f);
  }
  return sum;
}

/// Wrench of the spring on the part, K ξ*.
template <typename Simulation>
contact::Wrench spring_on_part(const Simulation& sliding) {
  const contact::Wrench on_hand = contact::spring_wrench(sliding.stiffness(), sliding.lag());
  return {-on_hand.f, -on_hand.t};
}

/// Sum of the wrenches of spring and contacts, relative to that of the spring, in the norm |F|² = |f|²/k_t + |t|²/k_r.
/// In this norm, a force and a torque that store the same energy are equal.
template <typename Simulation>
double imbalance(const Simulation& sliding) {
  const contact::CouplingStiffness& K = sliding.stiffness();
  const auto norm = [&](const Eigen::Vector3d& f, const Eigen::Vector3d& t) {
    return std::sqrt(f.squaredNorm() / K.translational + t.squaredNorm() / K.rotational);
  };
  const contact::Wrench spring = spring_on_part(sliding);
  const contact::Wrench contacts = sum_of_contacts(sliding);
  return norm(spring.f + contacts.f, spring.t + contacts.t) / norm(spring.f, spring.t);
}

/// ‖ξ‖_K = √(ξᵀ K ξ).
double length_in(const contact::CouplingStiffness& stiffness, const geometry::Displacement& d);

}  // namespace glissade::test_support
