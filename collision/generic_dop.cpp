#include "generic_dop.h"

#include <cmath>

#include <Eigen/LU>

#include <glissade/collision/dop.h>

namespace glissade::collision {
namespace {

/// Planes tangent to the unit sphere are all needed, but more than three may meet in a point. A small irregular shift
/// of the offsets, the same for opposite planes, tears such points apart and keeps every plane needed.
Eigen::Matrix<double, kDopDirections, 1> generic_offsets() {
  constexpr double kGoldenRatioFraction = 0.6180339887498949;
  Eigen::Matrix<double, kDopDirections, 1> offsets;
  for (int i = 0; i < kDopDirections; ++i) {
    const double step = (i % kDopSlabs + 1) * kGoldenRatioFraction;
    offsets[i] = dop_direction(i).norm() * (1.0 + 0.01 * (step - std::floor(step)));
  }
  return offsets;
}

std::vector<GenericVertex> compute_vertices() {
  const Eigen::Matrix<double, kDopDirections, 1> offsets = generic_offsets();
  const auto inside_all_others = [&](const Eigen::Vector3d& x, const std::array<int, 3>& own) {
    for (int i = 0; i < kDopDirections; ++i) {
      if (i == own[0] || i == own[1] || i == own[2]) continue;
      if (dop_direction(i).dot(x) > offsets[i]) return false;
    }
    return true;
  };

  std::vector<GenericVertex> vertices;
  for (int i = 0; i < kDopDirections; ++i) {
    for (int j = i + 1; j < kDopDirections; ++j) {
      for (int k = j + 1; k < kDopDirections; ++k) {
        Eigen::Matrix3d planes;  // one direction a row
        planes << dop_direction(i).transpose(), dop_direction(j).transpose(), dop_direction(k).transpose();
        if (std::abs(planes.determinant()) < 0.5) continue;  // integer directions: the determinant is 0 or at least 1
        const Eigen::Vector3d x = planes.inverse() * Eigen::Vector3d(offsets[i], offsets[j], offsets[k]);
        if (!inside_all_others(x, {i, j, k})) continue;
        vertices.push_back({x, {i, j, k}, planes.transpose().inverse()});
      }
    }
  }
  return vertices;
}

}  // namespace

const std::vector<GenericVertex>& generic_dop_vertices() {
  static const std::vector<GenericVertex> vertices = compute_vertices();
  return vertices;
}

}  // namespace glissade::collision
