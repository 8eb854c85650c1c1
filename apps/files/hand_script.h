#pragma once

/// Files of what a simulated hand is to do: timed poses, as of a trajectory, with a column `grip`, or with the angles
/// of the joints.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/apps/text.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::apps {

/// The joint angles of all rows, from the columns after those of a trajectory.
std::vector<devices::TimedAngles> fingers_from(const CsvTable& table);

/// Throws std::invalid_argument for a file that lasts longer than a day, which gives some 20 GB of rows:
/// that is an error in the unit of t_s.
void check_duration(std::chrono::nanoseconds duration, const std::string& file);

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
