#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <glissade/apps/csv.h>
#include <glissade/apps/poses_file.h>
#include <glissade/apps/text.h>
#include <glissade/apps/trajectory_file.h>

namespace glissade::apps {

namespace {

std::vector<std::string> trajectory_columns() {
  std::vector<std::string> columns{"t_s"};
  columns.insert(columns.end(), pose_columns().begin(), pose_columns().end());
  return columns;
}

std::chrono::nanoseconds time_of(double t_s, const std::string& where) {
  constexpr double kLatestSeconds = 1e9;
  if (std::abs(t_s) > kLatestSeconds) {
    throw std::invalid_argument(where + ": column t_s: " + format_number(t_s) + " is beyond 1e9 s");
  }
  return std::chrono::nanoseconds(std::llround(t_s * 1e9));
}

geometry::PoseTrajectory trajectory_from(const CsvTable& table) {
  std::vector<geometry::TimedPose> rows;
  rows.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::chrono::nanoseconds time = time_of(table.rows[row][0], table.where(row));
    if (!rows.empty() && time <= rows.back().time) {
      throw std::invalid_argument(table.where(row) + ": column t_s: the time " + format_number(table.rows[row][0]) +
                                  " does not rise above " + format_number(table.rows[row - 1][0]) +
                                  " of the row before");
    }
    rows.push_back({time, pose_from_row(table, row, 1)});
  }
  return geometry::PoseTrajectory(rows);
}

}  // namespace

geometry::PoseTrajectory read_trajectory(const std::string& path) {
  return trajectory_from(read_csv(path, trajectory_columns()));
}

geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source) {
  return trajectory_from(parse_csv(text, source, trajectory_columns()));
}

}  // namespace glissade::apps
