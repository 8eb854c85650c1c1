#include <cmath>
#include <stdexcept>
#include <utility>

#include <glissade/files/pose_files.h>
#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>

namespace glissade::files {
namespace {

/// The pose in a row whose `pose_columns()` begin at `first_column`.
Eigen::Isometry3d pose_from_row(const std::vector<double>& row, std::size_t first_column, const std::string& where) {
  const double* values = row.data() + first_column;
  const Eigen::Quaterniond q(values[3], values[4], values[5], values[6]);
  return checked_pose({values[0], values[1], values[2]}, q, where);
}

}  // namespace

std::vector<Eigen::Isometry3d> read_poses(const std::string& path) {
  const CsvTable table = read_csv(path, pose_columns());
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    poses.push_back(pose_from_row(table.rows[row], 0, table.where(row)));
  return poses;
}

std::chrono::nanoseconds time_of(double t_s, const std::string& where, const char* name) {
  constexpr double kLatestSeconds = 1e9;
  if (std::abs(t_s) > kLatestSeconds) {
    throw std::invalid_argument(where + ": " + name + ": " + format_number(t_s) + " is beyond 1e9 s");
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
  return geometry::PoseTrajectory(std::move(rows));
}

geometry::PoseTrajectory read_trajectory(const std::string& path) {
  return trajectory_from(read_csv(path, trajectory_columns()));
}

geometry::PoseTrajectory parse_trajectory(std::string_view text, const std::string& source) {
  return trajectory_from(parse_csv(text, source, trajectory_columns()));
}

}  // namespace glissade::files
