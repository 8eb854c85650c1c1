#pragma once

/// Files of timed poses: rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` at rising times.

#include <string>
#include <string_view>

#include <glissade/geometry/pose_trajectory.h>

namespace glissade::apps {

/// Reads a trajectory; times are rounded to nanoseconds.
/// Throws std::invalid_argument, naming file, line and value, when a time does not exceed that of the row before or is
/// beyond ±1e9 s, and for all that `read_csv` and `checked_pose` reject.
geometry::PoseTrajectory read_trajectory(const std::string& path);

/// The same for a text in memory; `source` replaces the file's name in messages.
geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source);

}  // namespace glissade::apps
