#pragma once

/// Files of timed poses: rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` at rising times; for a hand with a column `grip`, or with
/// the angles of its joints.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/apps/files/csv.h>
#include <glissade/apps/files/csv_columns.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::apps {

/// A row whose first columns are those of a trajectory, `where` it stands in its file, and the time of the row before,
/// if there is one. Throws as `read_trajectory`.
geometry::TimedPose timed_pose(const std::vector<double>& row, const std::string& where,
                               std::optional<std::chrono::nanoseconds> before);

/// The trajectory of all rows of a table whose first columns are those of a trajectory. Throws as `read_trajectory`.
geometry::PoseTrajectory trajectory_from(const CsvTable& table);
/// The joint angles of all rows, from the columns after those of a trajectory.
std::vector<devices::TimedAngles> fingers_from(const CsvTable& table);

/// Throws std::invalid_argument for a file that lasts longer than a day, which gives some 20 GB of rows:
/// that is an error in the unit of t_s.
void check_duration(std::chrono::nanoseconds duration, const std::string& file);

/// Reads a trajectory; times are rounded to nanoseconds.
/// Throws std::invalid_argument, naming file, line and value, when a time does not exceed that of the row before or is
/// beyond ±1e9 s, and for all that `read_csv` and `checked_pose` reject.
geometry::PoseTrajectory read_trajectory(const std::string& path);

/// The same for a text in memory; `source` replaces the file's name in messages.
geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source);

/// What a simulated hand is to do.
struct HandScript {
  geometry::PoseTrajectory X_WH;
  bool starts_closed = true;
  std::vector<std::chrono::nanoseconds> grip_changes{};  ///< times at which it closes or opens, ascending
  std::vector<devices::TimedAngles> fingers{};           ///< none: its fingers do not move

  /// The same in another time.
  HandScript time_scaled(std::chrono::nanoseconds duration) const;
  /// `parameters` with the grip and the fingers of this script.
  devices::SimulatedGloveParameters with_grip(devices::SimulatedGloveParameters parameters) const;
};

/// Reads a trajectory that may have one more column, `grip`: 1 from the time of the row on if the hand is closed, 0 if
/// it is open; or `joint_columns`. Throws as `read_trajectory`, and for any other number in the column `grip`.
HandScript read_hand_script(const std::string& path);
HandScript parse_hand_script(std::string_view text, const std::string& source);

}  // namespace glissade::apps
