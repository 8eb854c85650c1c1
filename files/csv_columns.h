#pragma once

/// The columns of the tables that the program reads, and which command reads a table.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::files {

/// Angles that stand for a quaternion; docs/file_formats.md has their order.
inline constexpr std::array<std::string_view, 3> kAngleColumns{"roll_deg", "pitch_deg", "yaw_deg"};

/// The header row of a table.
std::string header_of(const std::vector<std::string>& columns);

/// The columns of a pose: position in metres, unit quaternion.
const std::vector<std::string>& pose_columns();

/// The same table with an orientation by three angles, roll_deg, pitch_deg and yaw_deg, in place of the quaternion;
/// empty for a table without a quaternion.
std::vector<std::string> with_angles(const std::vector<std::string>& columns);

/// The columns of a trajectory: time and pose.
std::vector<std::string> trajectory_columns();

/// The columns of a hand's joints: `hands::kJointNames` with the ending `_rad`.
std::vector<std::string> joint_columns();

/// The columns of a hand trajectory: those of a trajectory and of the joints.
std::vector<std::string> hand_trajectory_columns();

/// What a table with this header row is, and which command reads it: "a file of poses, which 'glissade collide --poses'
/// reads"; empty if no command reads such a table.
std::string told_table(std::string_view header);

}  // namespace glissade::files
