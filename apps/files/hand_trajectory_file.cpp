#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <glissade/apps/files/csv.h>
#include <glissade/apps/files/hand_trajectory_file.h>
#include <glissade/apps/files/trajectory_file.h>
#include <glissade/apps/files/yaml_reader.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

std::vector<std::string> flex_columns() {
  std::vector<std::string> columns;
  for (const std::string_view name : devices::kGloveJointNames)
    columns.push_back(std::string(name) + "_rad");
  return columns;
}

HandTrajectory::HandTrajectory(geometry::PoseTrajectory X_WR, std::vector<std::chrono::nanoseconds> times,
                               std::vector<devices::JointValues> values)
    : X_WR_(std::move(X_WR)), times_(std::move(times)), values_(std::move(values)) {}

grasping::Posture HandTrajectory::posture_at(std::chrono::nanoseconds time) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), time);
  const auto after = static_cast<std::size_t>(std::min(next - times_.begin(), std::ssize(times_) - 1));
  const std::size_t before = next == times_.begin() ? 0 : static_cast<std::size_t>(next - times_.begin()) - 1;
  const auto span = static_cast<double>((times_[after] - times_[before]).count());
  const double share = span > 0.0 ? static_cast<double>((time - times_[before]).count()) / span : 0.0;
  grasping::Posture posture{X_WR_.pose_at(time), std::vector<double>(devices::kGloveJoints)};
  for (std::size_t v = 0; v < posture.values.size(); ++v)
    posture.values[v] = values_[before][v] + share * (values_[after][v] - values_[before][v]);
  return posture;
}

HandTrajectory read_hand_trajectory(const std::string& path) {
  std::vector<std::string> columns = trajectory_columns();
  const std::size_t first = columns.size();
  for (const std::string& column : flex_columns())
    columns.push_back(column);
  const CsvTable table = read_csv(path, columns);
  std::vector<std::chrono::nanoseconds> times;
  std::vector<devices::JointValues> values(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    times.push_back(time_of(table, row));
    std::copy_n(table.rows[row].begin() + static_cast<std::ptrdiff_t>(first), values[row].size(), values[row].begin());
  }
  return {trajectory_from(table), std::move(times), std::move(values)};
}

grasping::HandShape read_hand_shape(const std::string& path) {
  const YamlReader reader(path);
  const YAML::Node root = reader.parse(read_text_file(path));
  constexpr std::array<std::string_view, 3> kKeys{"side", "length_m", "breadth_m"};
  reader.check_keys(root, "a hand", kKeys);
  grasping::HandShape shape;
  if (const YAML::Node side = root["side"]) {
    const std::string name = reader.text(side, "side");
    if (name != "left" && name != "right") reader.fail(side, "key side: must be left or right, not '" + name + "'");
    shape.side = name == "left" ? devices::HandSide::kLeft : devices::HandSide::kRight;
  }
  if (const YAML::Node length = root["length_m"]) shape.length_m = reader.number(length, "length_m");
  if (const YAML::Node breadth = root["breadth_m"]) shape.breadth_m = reader.number(breadth, "breadth_m");
  return shape;
}

}  // namespace glissade::apps
