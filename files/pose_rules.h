#pragma once

/// Validation of poses in files.

#include <string>

#include <Eigen/Geometry>

namespace glissade::files {

/// Largest coordinate for which collision queries are exact.
inline constexpr double kLargestCoordinate_m = 1e9;

/// The rotation by angles in degrees about the fixed axes, x first, then y, then z: R = R_z(yaw) R_y(pitch) R_x(roll).
Eigen::Quaterniond rotation_of(double roll_deg, double pitch_deg, double yaw_deg);

/// The pose at `position` (metres) with the rotation `q` scaled to unit length.
///
/// Throws std::invalid_argument if the length of the quaternion deviates from 1 by more than 1e-3, or if a coordinate
/// of the position is beyond ±kLargestCoordinate_m. The message begins with `where` ("file:line").
Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q, const std::string& where);

/// The pose with the rotation matrix R: R itself if its `geometry::rotation_defect` is below 1e-12, otherwise the
/// nearest rotation. Throws for the same positions as above, for a defect above 1e-4, and for a reflection.
Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Matrix3d& R, const std::string& where);

}  // namespace glissade::files
