#include <cmath>
#include <stdexcept>

#include <glissade/files/poses_file.h>
#include <glissade/files/text.h>
#include <glissade/files/trajectory_file.h>

namespace glissade::files {

std::chrono::nanoseconds time_of(double t_s, const std::string& where) {
  constexpr double kLatestSeconds = 1e9;
  if (std::abs(t_s) > kLatestSeconds) {
    throw std::invalid_argument(where + ": column t_s: " + format_number(t_s) + " is beyond 1e9 s");
  }
  return std::chrono::nanoseconds(std::llround(t_s * 1e9));
}

geometry::TimedPose timed_pose(const std::vector<double>& row, const std::string& where,
                               std::optional<std::chrono::nanoseconds> before) {
  const std::chrono::nanoseconds time = time_of(row[0], where);
  if (before && time <= *before) {
    throw std::invalid_argument(where + ": column t_s: the time " + format_number(row[0]) + " does not rise above " +
                                format_number(std::chrono::duration<double>(*before).count()) +
                                " of the row before (to the nanosecond)");
  }
  return {time, pose_from_row(row, 1, where)};
}

geometry::PoseTrajectory trajectory_from(const CsvTable& table) {
  std::vector<geometry::TimedPose> rows;
  rows.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto before = rows.empty() ? std::nullopt : std::optional(rows.back().time);
    rows.push_back(timed_pose(table.rows[row], table.where(row), before));
  }
  return geometry::PoseTrajectory(rows);
}

geometry::PoseTrajectory read_trajectory(const std::string& path) {
  return trajectory_from(read_csv(path, trajectory_columns()));
}

geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source) {
  return trajectory_from(parse_csv(text, source, trajectory_columns()));
}

}  // namespace glissade::files
