#pragma once

/// Files of poses, with rows `x_m,y_m,z_m,qw,qx,qy,qz`, and trajectories, with rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` at
/// increasing times.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::files {

/// The poses X_AB of a file, in the order of its rows. Throws std::invalid_argument, naming file, line and value: see
/// `read_csv` and `checked_pose`.
std::vector<Eigen::Isometry3d> read_poses(const std::string& path);

/// `t_s` rounded to nanoseconds. Throws std::invalid_argument for a time beyond ±1e9 s. The message begins with `where`
/// ("file:line") and `name`.
std::chrono::nanoseconds time_of(double t_s, const std::string& where, const char* name = "column t_s");

/// The timed pose of a row whose first columns are those of a trajectory. `where` is the place of the row
/// ("file:line"), and `before` is the time of the row before, if there is one. Throws what `read_trajectory` throws.
geometry::TimedPose timed_pose(const std::vector<double>& row, const std::string& where,
                               std::optional<std::chrono::nanoseconds> before);

/// The trajectory of all rows of a table whose first columns are those of a trajectory. Throws what `read_trajectory`
/// throws.
geometry::PoseTrajectory trajectory_from(const CsvTable& table);

/// Reads a trajectory; times are rounded to nanoseconds. Throws std::invalid_argument, naming file, line and value, if
/// a time does not exceed the time of the row before, or is beyond ±1e9 s. Also throws what `read_csv` and
/// `checked_pose` throw.
geometry::PoseTrajectory read_trajectory(const std::string& path);

/// Like `read_trajectory`, for a text in memory. `source` replaces the file's name in messages.
geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source);

}  // namespace glissade::files
