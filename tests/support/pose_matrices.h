#pragma once

/// Poses in files, as NumPy writes matrices.

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::test_support {

using PoseMatrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// The poses of a file of matrices of 16 doubles, row by row.
inline std::vector<Eigen::Isometry3d> read_poses(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<Eigen::Isometry3d> poses(bytes.size() / sizeof(PoseMatrix));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseMatrix matrix;
    std::copy_n(bytes.data() + i * sizeof(PoseMatrix), sizeof(PoseMatrix), reinterpret_cast<char*>(matrix.data()));
    poses[i].matrix() = matrix;
  }
  return poses;
}

}  // namespace glissade::test_support
