#pragma once

/// Files of poses: one row `x_m,y_m,z_m,qw,qx,qy,qz` each.

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>

namespace glissade::files {

/// The poses X_AB of a file, in its order.
/// Throws std::invalid_argument, naming file, line and value: see `read_csv` and `checked_pose`.
std::vector<Eigen::Isometry3d> read_poses(const std::string& path);

/// The pose in a row whose `pose_columns()` begin at `first_column`. Throws like `checked_pose`.
Eigen::Isometry3d pose_from_row(const std::vector<double>& row, std::size_t first_column, const std::string& where);

}  // namespace glissade::files
