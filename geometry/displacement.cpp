#include <algorithm>
#include <cmath>
#include <numbers>

#include <glissade/geometry/displacement.h>

namespace glissade::geometry {
namespace {

// Of rotations: no defect, the greatest that is mended; of positions, the greatest coordinate, m.
constexpr double kNone = 1e-12;
constexpr double kMost = 1e-4;
constexpr double kMostCoordinate = 1e9;

Eigen::Vector3d log_rotation(Eigen::Quaterniond q) {
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-8) return 2.0 * q.vec();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

}  // namespace

Eigen::Quaterniond rotation_by(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // sin(a/2)/a, by its series where the quotient would lose digits.
  const double half_sinc = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = half_sinc * w;
  return q;
}

Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WV, const Eigen::Vector3d& p_Vref, const Displacement& d) {
  const Eigen::Quaterniond q_WV(X_WV.linear());
  const Eigen::Vector3d p_Wref = X_WV * p_Vref + d.v;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = (rotation_by(d.w) * q_WV).normalized().toRotationMatrix();
  X.translation() = p_Wref - X.linear() * p_Vref;
  return X;
}

Displacement displacement_between(const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG,
                                  const Eigen::Vector3d& p_Vref) {
  const Eigen::Quaterniond q_WV(X_WV.linear());
  const Eigen::Quaterniond q_WG(X_WG.linear());
  return {X_WG * p_Vref - X_WV * p_Vref, log_rotation((q_WG * q_WV.conjugate()).normalized())};
}

double motion_bound(const Displacement& d, double radius) {
  const double angle = std::min(d.w.norm(), std::numbers::pi);
  return d.v.norm() + 2.0 * std::sin(0.5 * angle) * radius;
}

double fraction_within(const Displacement& d, double radius, double longest) {
  longest = std::max(0.0, longest);
  if (motion_bound(d, radius) <= longest) return 1.0;
  // For the angle a, the chord 2 sin(f a / 2) is at most the arc f a, but may exceed the scaled chord f · 2 sin(a / 2).
  return longest / (d.v.norm() + d.w.norm() * radius);
}

std::optional<Eigen::Isometry3d> rigid_pose(const Eigen::Isometry3d& X) noexcept {
  if (!(X.translation().array().abs() <= kMostCoordinate).all()) return std::nullopt;
  if (rotation_defect_bound(X.linear()) < kNone) return X;
  double defect = rotation_defect(X.linear());
  if (!(defect < kMost) || !is_right_handed(X.linear())) return std::nullopt;
  Eigen::Isometry3d rigid = X;
  // Newton's iteration for the nearest rotation squares the defect; two steps are enough.
  while (!(defect < kNone)) {
    const Eigen::Matrix3d R = rigid.linear();
    rigid.linear() = 0.5 * R * (3.0 * Eigen::Matrix3d::Identity() - R.transpose() * R);
    defect = rotation_defect(rigid.linear());
  }
  return rigid;
}

}  // namespace glissade::geometry
