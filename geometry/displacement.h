#pragma once

/// Displacements of a rigid part about a reference point fixed in the part, and bounds on the motion of the part's
/// points. Also functions for rigid poses, and measures of how far a matrix is from a rotation.

#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>

namespace glissade::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A displacement of a rigid part: translation `v` of its reference point (metres) and rotation vector `w` about the
/// reference point (radians), both in world axes. Over the path parameter t in [0, 1], a point x of the part moves as
/// x(t) = p + t v + exp(t w) (x − p), where p is the reference point at t = 0.
struct Displacement {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();

  Displacement scaled(double factor) const { return {factor * v, factor * w}; }
  bool is_zero() const { return v.isZero(0.0) && w.isZero(0.0); }
  Vector6d stacked() const { return (Vector6d() << v, w).finished(); }
};

/// The rotation by the angle |w| (radians) about the axis w.
GLISSADE_EXPORT Eigen::Quaterniond rotation_by(const Eigen::Vector3d& w);

/// The pose of a part after a displacement from X_WV. `p_Vref` is the reference point in the part's frame. The rotation
/// of the result stays orthonormal up to rounding after any number of successive displacements.
GLISSADE_EXPORT Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WV, const Eigen::Vector3d& p_Vref,
                                            const Displacement& d);

/// The displacement (p_G − p_V, log(R_G R_Vᵀ)) that takes the part from X_WV to X_WG. Here p_V and p_G are the
/// positions of the reference point in the world before and after the displacement. `p_Vref` is the reference point in
/// the part's frame.
GLISSADE_EXPORT Displacement displacement_between(const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG,
                                                  const Eigen::Vector3d& p_Vref);

/// Upper bound (metres) of |x(t) − x(0)| for every point x of a part and every t during a displacement. The bound is
/// |v| + 2 sin(|w|/2) ρ. Here ρ = `radius` is the largest distance of a point of the part from the reference point. An
/// angle |w| beyond π counts as π.
GLISSADE_EXPORT double motion_bound(const Displacement& d, double radius);

/// A fraction f in [0, 1] with motion_bound(d.scaled(f), radius) ≤ `longest` (metres). f is 1 if the whole displacement
/// d satisfies this inequality. f differs from `longest` / motion_bound(d, radius), because `motion_bound` is not
/// linear.
GLISSADE_EXPORT double fraction_within(const Displacement& d, double radius, double longest);

/// The rigid pose nearest to an almost rigid X = (R, p):
/// - If the `rotation_defect` of R is below 1e-12, the result is X itself. A product of a few rotations always has such
///   a small defect.
/// - If the defect is between 1e-12 and 1e-4, the nearest rotation replaces R.
/// - For a larger defect, for a reflection, and for a coordinate of p that is not finite or beyond ±1e9 m, the result
///   is std::nullopt.
///
/// So the rotation of every result has a defect below 1e-12, and error bounds for rotations apply to the result. Cost:
/// about ten nanoseconds.
GLISSADE_EXPORT std::optional<Eigen::Isometry3d> rigid_pose(const Eigen::Isometry3d& X) noexcept;

/// The defect δ: the sum of the absolute values of the entries of RᵀR − 1, where 1 is the identity matrix. The defect
/// is 0 for an exact rotation or reflection. The defect is an upper bound of every common norm of RᵀR − 1. The defect
/// is not finite if R has an entry that is not finite.
inline double rotation_defect(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const Eigen::Vector3d z = R.col(2);
  return std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + std::abs(z.squaredNorm() - 1.0) +
         2.0 * (std::abs(x.dot(y)) + std::abs(y.dot(z)) + std::abs(z.dot(x)));
}

/// An upper bound of `rotation_defect` for matrices of small defect. The bound is faster to compute than the defect
/// itself. The bound is 0 for an exact rotation, and more than 1 for a reflection.
inline double rotation_defect_bound(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const double xy = std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + 2.0 * std::abs(x.dot(y));
  return 3.0 * xy + 7.0 * (x.cross(y) - R.col(2)).lpNorm<1>();
}

/// Whether a matrix R of small defect approximates a rotation, not a reflection.
inline bool is_right_handed(const Eigen::Matrix3d& R) {
  return R.col(0).cross(R.col(1)).dot(R.col(2)) > 0.0;
}

}  // namespace glissade::geometry
