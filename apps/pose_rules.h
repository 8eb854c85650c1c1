#pragma once

/// The one rule for poses in files.

#include <string>

#include <Eigen/Geometry>

namespace glissade::apps {

/// The collision queries promise to be exact so far out.
inline constexpr double kLargestCoordinate_m = 1e9;

/// The pose at `position` (metres) with the rotation `q` scaled to unit length.
///
/// Throws std::invalid_argument, beginning with `where` ("file:line"), when the quaternion is zero or off unit length
/// by more than 1e-3, and when the position is beyond kLargestCoordinate_m.
Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q, const std::string& where);

}  // namespace glissade::apps
