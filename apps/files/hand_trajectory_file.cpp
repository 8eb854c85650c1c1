#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/files/hand_trajectory_file.h>
#include <glissade/apps/text.h>
#include <glissade/files/csv.h>
#include <glissade/files/pose_files.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>

namespace glissade::apps {

grasping::Posture HandTrajectory::posture_at(std::chrono::nanoseconds time) const {
  const hands::JointValues values = devices::angles_at(values_, time);
  return {X_WR_.pose_at(time), {values.begin(), values.end()}};
}

double HandTrajectory::greatest_angle() const {
  double greatest = 0.0;
  for (const devices::TimedAngles& row : values_) {
    for (const double angle : row.angles)
      greatest = std::max(greatest, std::abs(angle));
  }
  return greatest;
}

HandTrajectory read_hand_trajectory(const std::string& path) {
  const CsvTable table = read_csv(path, hand_trajectory_columns());
  return {trajectory_from(table), fingers_from(table)};
}

grasping::HandShape read_hand_shape(const std::string& path) {
  YamlReader reader(path);
  const YAML::Node root = reader.parse(read_text_file(path));
  constexpr std::array<std::string_view, 3> kKeys{"side", "length_m", "breadth_m"};
  reader.check_keys(root, "a hand", kKeys);
  grasping::HandShape shape;
  if (const YAML::Node side = root["side"]) {
    const std::string name = reader.text(side, "side");
    if (name != "left" && name != "right") reader.fail(side, "key side: must be left or right, not '" + name + "'");
    shape.side = name == "left" ? hands::HandSide::kLeft : hands::HandSide::kRight;
  }
  if (const YAML::Node length = root["length_m"]) shape.length_m = reader.number(length, "length_m");
  if (const YAML::Node breadth = root["breadth_m"]) shape.breadth_m = reader.number(breadth, "breadth_m");
  return shape;
}

}  // namespace glissade::apps
