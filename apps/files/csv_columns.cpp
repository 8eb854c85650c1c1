#include <glissade/apps/files/csv_columns.h>
#include <glissade/devices/glove_device.h>

namespace glissade::apps {

std::string header_of(const std::vector<std::string>& columns) {
  std::string header;
  for (const std::string& column : columns)
    header += (header.empty() ? "" : ",") + column;
  return header;
}

const std::vector<std::string>& pose_columns() {
  static const std::vector<std::string> columns{"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  return columns;
}

std::vector<std::string> trajectory_columns() {
  std::vector<std::string> columns{"t_s"};
  columns.insert(columns.end(), pose_columns().begin(), pose_columns().end());
  return columns;
}

std::vector<std::string> joint_columns() {
  std::vector<std::string> columns;
  for (const std::string_view name : devices::kGloveJointNames)
    columns.push_back(std::string(name) + "_rad");
  return columns;
}

std::vector<std::string> hand_trajectory_columns() {
  std::vector<std::string> columns = trajectory_columns();
  for (const std::string& column : joint_columns())
    columns.push_back(column);
  return columns;
}

std::string told_table(std::string_view header) {
  if (header == header_of(pose_columns())) return "a file of poses, which 'glissade collide --poses' reads";
  if (header == header_of(trajectory_columns())) {
    return "the trajectory of a part, which 'glissade slide --trajectory' reads";
  }
  if (header == header_of(hand_trajectory_columns())) {
    return "the trajectory of a hand with fingers, which 'glissade grasp --hand-trajectory' reads";
  }
  if (header == header_of(trajectory_columns()) + ",grip") {
    return "the script of a hand, which 'glissade glove --script' reads";
  }
  return "";
}

}  // namespace glissade::apps
