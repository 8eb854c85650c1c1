#pragma once

/// Files of poses: rows `x_m,y_m,z_m,qw,qx,qy,qz`, or trajectories: rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` at rising times.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::files {

/// The poses X_AB of a file, in its order.
/// Throws std::invalid_argument, naming file, line and value: see `read_csv` and `checked_pose`.
std::vector<Eigen::Isometry3d> read_poses(const std::string& path);

/// `t_s` rounded to nanoseconds. Throws std::invalid_argument, beginning with `where` ("file:line") and `name`, beyond
/// ±1e9 s.
std::chrono::nanoseconds time_of(double t_s, const std::string& where, const char* name = "column t_s");

/// A row whose first columns are those of a trajectory, `where` it stands in its file, and the time of the row before,
/// if there is one. Throws as `read_trajectory`.
geometry::TimedPose timed_pose(const std::vector<double>& row, const std::string& where,
                               std::optional<std::chrono::nanoseconds> before);

/// The trajectory of all rows of a table whose first columns are those of a trajectory. Throws as `read_trajectory`.
geometry::PoseTrajectory trajectory_from(const CsvTable& table);

/// Reads a trajectory; times are rounded to nanoseconds.
/// Throws std::invalid_argument, naming file, line and value, when a time does not exceed that of the row before or is
/// beyond ±1e9 s, and for all that `read_csv` and `checked_pose` reject.
geometry::PoseTrajectory read_trajectory(const std::string& path);

/// The same for a text in memory; `source` replaces the file's name in messages.
geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source);

}  // namespace glissade::files
