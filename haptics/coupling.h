#pragma once

/// The virtual coupling: the spring and damper between the hand and the visible part, and the wrench the hand feels.

#include <algorithm>

#include <Eigen/Core>

#include <glissade/haptics/motion.h>
#include <glissade/haptics/projection.h>

namespace glissade::haptics {

/// Force (N) and torque (Nm) on a body about some point, in world axes.
struct Wrench {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// The same wrench about another point: `from` and `to` in world coordinates, metres.
inline Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {wrench.f, wrench.t + (from - to).cross(wrench.f)};
}

/// The spring's wrench on the hand about the ghost's reference point: −K ξ*, where `error` ξ* is the displacement from
/// the visible part to the ghost. Exactly zero when they coincide. As the part was projected in the metric of K, it is
/// a sum of contact normals: sliding is without friction.
inline Wrench spring_wrench(const CouplingStiffness& stiffness, const Displacement& error) {
  return {-stiffness.translational * error.v, -stiffness.rotational * error.w};
}

/// Damping of the coupling: N s/m against translation, Nm s/rad against rotation, of the reference point.
struct CouplingDamping {
  double translational;
  double rotational;
};

/// Velocity of the ghost: of its reference point (m/s) and angular (rad/s), in world axes.
struct Velocity {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
};

/// The damper's wrench on the hand. It acts along the spring's force and torque only, since against fixed obstacles the
/// part moves freely across them, and never exceeds them: so it sets in smoothly when contact is made, and never pulls
/// the hand towards a contact it leaves.
inline Wrench damper_wrench(const CouplingDamping& damping, const Wrench& spring, const Velocity& ghost) {
  const auto along = [](const Eigen::Vector3d& push, double coefficient, const Eigen::Vector3d& velocity) {
    const double magnitude = push.norm();
    if (magnitude == 0.0) return Eigen::Vector3d(Eigen::Vector3d::Zero());
    const Eigen::Vector3d direction = push / magnitude;
    return Eigen::Vector3d(std::clamp(-coefficient * velocity.dot(direction), -magnitude, magnitude) * direction);
  };
  return {along(spring.f, damping.translational, ghost.v), along(spring.t, damping.rotational, ghost.w)};
}

}  // namespace glissade::haptics
