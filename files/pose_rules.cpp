#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/geometry/displacement.h>

namespace glissade::files {

namespace {

constexpr double kLengthTolerance = 1e-3;

std::string spaced(const Eigen::Vector4d& values) {
  return format_number(values[0]) + " " + format_number(values[1]) + " " + format_number(values[2]) + " " +
         format_number(values[3]);
}

}  // namespace

Eigen::Quaterniond rotation_of(double roll_deg, double pitch_deg, double yaw_deg) {
  const auto about = [](double angle_deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(std::remainder(angle_deg, 360.0) * std::numbers::pi / 180.0, axis);
  };
  return about(yaw_deg, Eigen::Vector3d::UnitZ()) * about(pitch_deg, Eigen::Vector3d::UnitY()) *
         about(roll_deg, Eigen::Vector3d::UnitX());
}

Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q, const std::string& where) {
  const double length = q.norm();
  // Written so that a length that is not a number fails as well.
  if (!(std::abs(length - 1.0) <= kLengthTolerance)) {
    throw std::invalid_argument(
        where + ": the quaternion (w x y z) " + spaced(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())) +
        (length == 0.0 ? " is zero" : " has length " + format_number(length) + " instead of 1"));
  }
  return checked_pose(position, Eigen::Matrix3d(q.normalized().toRotationMatrix()), where);
}

Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Matrix3d& R, const std::string& where) {
  for (const double coordinate : position) {
    if (std::abs(coordinate) > kLargestCoordinate_m) {
      throw std::invalid_argument(where + ": the position " + format_number(coordinate) + " is beyond 1e9 m");
    }
  }
  Eigen::Isometry3d given = Eigen::Isometry3d::Identity();
  given.linear() = R;
  given.translation() = position;
  const std::optional<Eigen::Isometry3d> X = geometry::rigid_pose(given);
  if (!X) throw std::invalid_argument(where + ": is no rotation; its columns must be of length 1, at right angles");
  return *X;
}

}  // namespace glissade::files
