#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/text.h>
#include <glissade/files/csv.h>
#include <glissade/files/pose_files.h>
#include <glissade/files/text_file.h>

namespace glissade::apps {

std::vector<devices::TimedAngles> fingers_from(const CsvTable& table) {
  const auto first = static_cast<std::ptrdiff_t>(trajectory_columns().size());
  std::vector<devices::TimedAngles> fingers(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    fingers[row].time = time_of(table.rows[row][0], table.where(row));
    std::copy_n(table.rows[row].begin() + first, fingers[row].angles.size(), fingers[row].angles.begin());
  }
  return fingers;
}

HandScript HandScript::time_scaled(std::chrono::nanoseconds duration) const {
  HandScript scaled{X_WH.time_scaled(duration), starts_closed, {}, fingers};
  const double factor = static_cast<double>(duration.count()) / static_cast<double>(X_WH.duration().count());
  const auto in_new_time = [&](std::chrono::nanoseconds time) {
    const auto since_start = static_cast<double>((time - X_WH.first_time()).count());
    return X_WH.first_time() + std::chrono::nanoseconds(std::llround(factor * since_start));
  };
  for (const std::chrono::nanoseconds time : grip_changes)
    scaled.grip_changes.push_back(in_new_time(time));
  for (devices::TimedAngles& entry : scaled.fingers)
    entry.time = in_new_time(entry.time);
  return scaled;
}

devices::SimulatedGloveParameters HandScript::with_grip(devices::SimulatedGloveParameters parameters) const {
  parameters.starts_closed = starts_closed;
  parameters.grip_changes = grip_changes;
  parameters.fingers = fingers;
  return parameters;
}

HandScript parse_hand_script(std::string_view text, const std::string& source) {
  const std::string_view header = text.substr(0, text.find_first_of("\r\n"));
  if (header.find("," + joint_columns().front()) != std::string_view::npos) {
    const CsvTable table = parse_csv(text, source, hand_trajectory_columns());
    return {.X_WH = trajectory_from(table), .fingers = fingers_from(table)};
  }
  if (!header.ends_with(",grip")) return {.X_WH = parse_trajectory(text, source)};
  std::vector<std::string> columns = trajectory_columns();
  columns.emplace_back("grip");
  const CsvTable table = parse_csv(text, source, columns);
  HandScript script{.X_WH = trajectory_from(table)};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double grip = table.rows[row].back();
    if (grip != 0.0 && grip != 1.0) {
      throw std::invalid_argument(table.where(row) + ": column grip: must be 0 (open) or 1 (closed), not " +
                                  format_number(grip));
    }
    if (row == 0) {
      script.starts_closed = grip == 1.0;
    } else if (grip != table.rows[row - 1].back()) {
      script.grip_changes.push_back(time_of(table.rows[row][0], table.where(row)));
    }
  }
  return script;
}

HandScript read_hand_script(const std::string& path) {
  return parse_hand_script(read_text_file(path), path);
}

void check_duration(std::chrono::nanoseconds duration, const std::string& file) {
  constexpr std::chrono::hours kLongest{24};
  if (duration <= kLongest) return;
  const double duration_s = std::chrono::duration<double>(duration).count();
  throw std::invalid_argument(file + ": lasts " + format_number(duration_s) + " s, longer than a day (86400 s)");
}

}  // namespace glissade::apps
