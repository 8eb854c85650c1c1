#pragma once

/// Displacements of a rigid part about its reference point, a point fixed in the part, and bounds on the motion of the
/// part's points.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A displacement of a rigid part: translation `v` of its reference point (metres) and rotation vector `w` about that
/// point (radians), both in world axes. Over the path parameter t in [0, 1], a point x of the part moves as
/// x(t) = p + t v + exp(t w) (x − p), where p is the reference point at t = 0.
struct Displacement {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();

  Displacement scaled(double factor) const { return {factor * v, factor * w}; }
  bool is_zero() const { return v.isZero(0.0) && w.isZero(0.0); }
  Vector6d stacked() const { return (Vector6d() << v, w).finished(); }
};

/// The rotation by the angle |w| (radians) about w.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& w);

/// The pose of a part after a displacement from X_WV; `p_Vref` is the reference point in the part's frame. The rotation
/// of the result stays orthonormal to rounding, however many displacements are chained.
Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WV, const Eigen::Vector3d& p_Vref, const Displacement& d);

/// The displacement that takes the part from X_WV to X_WG: (p_G − p_V, log(R_G R_Vᵀ)), where p_V and p_G are the
/// positions of the reference point in the world before and after. `p_Vref` is the reference point in the part's frame.
Displacement displacement_between(const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG,
                                  const Eigen::Vector3d& p_Vref);

/// Upper bound (metres) on the distance |x(t) − x(0)| of any point x of a part from its start, for every t of the path
/// of a displacement. The bound is |v| + 2 sin(|w|/2) ρ, where ρ = `radius` is the largest distance of a point of the
/// part from the reference point. An angle |w| beyond π counts as π.
double motion_bound(const Displacement& d, double radius);

/// A fraction f in [0, 1] with motion_bound(d.scaled(f), radius) ≤ `longest` (metres). The fraction is 1 if the whole
/// displacement d satisfies this inequality. Because `motion_bound` is not linear in d, f is not simply `longest` /
/// motion_bound(d, radius).
double fraction_within(const Displacement& d, double radius, double longest);

}  // namespace glissade::geometry
