#pragma once

/// The spring of the virtual coupling between the visible part and its target, and the spring's wrench on the hand.

#include <string>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

/// The lag of a part is the displacement from the visible part to its target (`SlidingResult`). Under force feedback,
/// the lag changes in a millisecond by at most kSlew_m (metres) plus the motion of the ghost. With several parts, the
/// bound includes the motions of all ghosts. This limit bounds the change of the force when the part snaps into a gap.
inline constexpr double kSlew_m = 0.2e-3;

/// Stiffness of the spring against translation (N/m) of the part's reference point, and against rotation (Nm/rad) about
/// this point. The simulation projects the wanted displacement of the part on the displacements that the contacts
/// allow. The stiffness is also the metric of this projection.
struct CouplingStiffness {
  double translational;
  double rotational;
};

/// Throws std::invalid_argument, naming the part by `part_name`, unless both numbers are positive and finite.
GLISSADE_EXPORT void validate(const CouplingStiffness& stiffness, const std::string& part_name);

/// The default stiffness of the coupling against translation.
inline constexpr double kUsualStiffness_N_per_m = 1000.0;

/// The stiffness for a part of radius ρ (metres). The stiffness against rotation is ρ² times `translational`.
GLISSADE_EXPORT CouplingStiffness stiffness_of_part(double radius, double translational = kUsualStiffness_N_per_m);

/// Force `f` (N) on a body, and torque `t` (Nm) about some point, in world axes.
struct Wrench {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// The wrench, multiplied by a factor.
inline Wrench scaled(const Wrench& wrench, double factor) {
  return {factor * wrench.f, factor * wrench.t};
}

/// Converts a wrench about the point `from` to the point `to`. Both points are in world coordinates (metres).
GLISSADE_EXPORT Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The spring's wrench −K ξ* on the hand about the ghost's reference point. K is `stiffness`. ξ* is `error`, the
/// displacement from the visible part to its target. The wrench is exactly zero if `error` is zero. Because K is the
/// metric of the projection, the wrench on a part at rest is a sum of forces along contact normals. So the hand feels
/// no friction, unless `SlidingRules::friction` is set.
GLISSADE_EXPORT Wrench spring_wrench(const CouplingStiffness& stiffness, const geometry::Displacement& error);

}  // namespace glissade::contact
