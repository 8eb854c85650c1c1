#include <algorithm>
#include <array>

#include <glissade/files/csv_columns.h>
#include <glissade/hands/hand.h>

namespace glissade::files {

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

std::vector<std::string> with_angles(const std::vector<std::string>& columns) {
  static const std::array<std::string, 4> quaternion{"qw", "qx", "qy", "qz"};
  const auto begin = std::search(columns.begin(), columns.end(), quaternion.begin(), quaternion.end());
  if (begin == columns.end()) return {};
  std::vector<std::string> result(columns.begin(), begin);
  for (const std::string_view column : kAngleColumns)
    result.emplace_back(column);
  result.insert(result.end(), begin + quaternion.size(), columns.end());
  return result;
}

std::vector<std::string> trajectory_columns() {
  std::vector<std::string> columns{"t_s"};
  columns.insert(columns.end(), pose_columns().begin(), pose_columns().end());
  return columns;
}

std::vector<std::string> joint_columns() {
  std::vector<std::string> columns;
  for (const std::string_view name : hands::kJointNames)
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
  const auto is = [header](const std::vector<std::string>& columns) {
    return header == header_of(columns) || header == header_of(with_angles(columns));
  };
  if (is(pose_columns())) return "a file of poses, which 'glissade collide --poses' reads";
  if (is(trajectory_columns())) {
    return "the trajectory of a part, which 'glissade slide --trajectory' reads";
  }
  if (is(hand_trajectory_columns())) {
    return "the trajectory of a hand with fingers, which 'glissade grasp --hand-trajectory' reads";
  }
  std::vector<std::string> script = trajectory_columns();
  script.emplace_back("grip");
  if (is(script)) {
    return "the script of a hand, which 'glissade glove --script' reads";
  }
  return "";
}

}  // namespace glissade::files
