#include <glissade/geometry/rigid_pose.h>

namespace glissade::geometry {
namespace {

constexpr double kNone = 1e-12;
constexpr double kMost = 1e-4;
constexpr double kMostCoordinate = 1e9;

}  // namespace

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
