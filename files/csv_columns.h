#pragma once

/// The columns of the tables that the program reads, and the commands that read these tables.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::files {

/// Angles that may replace a quaternion. docs/file_formats.md has the order of the rotations.
inline constexpr std::array<std::string_view, 3> kAngleColumns{"roll_deg", "pitch_deg", "yaw_deg"};

/// The header row of a table.
std::string header_of(const std::vector<std::string>& columns);

/// The columns of a pose: position in metres, unit quaternion.
const std::vector<std::string>& pose_columns();

/// `columns` with the angles roll_deg, pitch_deg and yaw_deg in place of the quaternion; empty if `columns` has no
/// quaternion.
std::vector<std::string> with_angles(const std::vector<std::string>& columns);

/// The columns of a trajectory: time and pose.
std::vector<std::string> trajectory_columns();

/// The columns of a hand's joints: `hands::kJointNames` with the ending `_rad`.
std::vector<std::string> joint_columns();

/// The columns of a hand trajectory: those of a trajectory and of the joints.
std::vector<std::string> hand_trajectory_columns();

/// The kind of a table with this header row, and the command that reads the table, such as "a file of poses, which
/// 'glissade collide --poses' reads"; empty if no command reads such a table.
std::string told_table(std::string_view header);

}  // namespace glissade::files
