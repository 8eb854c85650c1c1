#pragma once

/// The one rule for poses in files.

#include <string>

#include <Eigen/Geometry>

namespace glissade::apps {

/// The pose at `position` (metres) with the rotation `q` scaled to unit length.
///
/// Throws std::invalid_argument, beginning with `where` ("file:line"), when the quaternion is zero or off unit length
/// by more than 1e-3, and when the position is beyond the ±1e9 m that the collision queries promise to be exact for.
Eigen::Isometry3d checked_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q, const std::string& where);

}  // namespace glissade::apps
