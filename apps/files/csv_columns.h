#pragma once

/// The columns of the tables that the program reads, and which command reads a table.

#include <string>
#include <string_view>
#include <vector>

namespace glissade::apps {

/// The header row of a table.
std::string header_of(const std::vector<std::string>& columns);

/// The columns of a pose: position in metres, unit quaternion.
const std::vector<std::string>& pose_columns();

/// The columns of a trajectory: time and pose.
std::vector<std::string> trajectory_columns();

/// The columns of a hand's joints: `devices::kGloveJointNames` with the ending `_rad`.
std::vector<std::string> joint_columns();

/// The columns of a hand trajectory: those of a trajectory and of the joints.
std::vector<std::string> hand_trajectory_columns();

/// What a table with this header row is, and which command reads it: "a file of poses, which 'glissade collide --poses'
/// reads"; empty if no command reads such a table.
std::string told_table(std::string_view header);

}  // namespace glissade::apps
