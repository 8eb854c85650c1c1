#include <glissade/files/pose_rules.h>
#include <glissade/files/poses_file.h>

namespace glissade::files {

std::vector<Eigen::Isometry3d> read_poses(const std::string& path) {
  const CsvTable table = read_csv(path, pose_columns());
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    poses.push_back(pose_from_row(table.rows[row], 0, table.where(row)));
  return poses;
}

Eigen::Isometry3d pose_from_row(const std::vector<double>& row, std::size_t first_column, const std::string& where) {
  const double* values = row.data() + first_column;
  return checked_pose({values[0], values[1], values[2]}, {values[3], values[4], values[5], values[6]}, where);
}

}  // namespace glissade::files
