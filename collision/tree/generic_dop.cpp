#include "tree/generic_dop.h"

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "tree/dop.h"

namespace glissade::collision {
namespace {

/// All planes tangent to the unit sphere support faces, but more than three of them may meet in a point. A small
/// irregular shift of the offsets, the same for opposite planes, separates such points and keeps every face.
double generic_offset(const DopDirections& directions, int half_space) {
  constexpr double kGoldenRatioFraction = 0.6180339887498949;
  const double step = (half_space % directions.slabs + 1) * kGoldenRatioFraction;
  return 1.0 + 0.01 * (step - std::floor(step));
}

bool inside_all(const DopDirections& directions, const Eigen::Vector3d& x, const std::array<int, 3>& except) {
  for (int i = 0; i < 2 * directions.slabs; ++i) {
    if (i == except[0] || i == except[1] || i == except[2]) continue;
    if (directions.half_space(i).dot(x) > generic_offset(directions, i)) return false;
  }
  return true;
}

// Of two mirrored vertices, keeps the one found with the lowest half-space, which is then one of positive direction.
std::vector<GenericVertex> compute_vertices(const DopDirections& directions) {
  const auto seen_mirrored = [&](const std::vector<GenericVertex>& vertices, const Eigen::Vector3d& x) {
    for (const GenericVertex& vertex : vertices) {
      if ((vertex.position + x).norm() < 1e-9) return true;
    }
    return false;
  };

  std::vector<GenericVertex> vertices;
  const int half_spaces = 2 * directions.slabs;
  for (int i = 0; i < half_spaces; ++i) {
    for (int j = i + 1; j < half_spaces; ++j) {
      for (int l = j + 1; l < half_spaces; ++l) {
        Eigen::Matrix3d planes;  // one direction a row
        planes << directions.half_space(i).transpose(), directions.half_space(j).transpose(),
            directions.half_space(l).transpose();
        if (std::abs(planes.determinant()) < 0.1) continue;  // determinants of such directions are 0 or much larger
        const Eigen::Vector3d x =
            planes.inverse() * Eigen::Vector3d(generic_offset(directions, i), generic_offset(directions, j),
                                               generic_offset(directions, l));
        if (!inside_all(directions, x, {i, j, l}) || seen_mirrored(vertices, x)) continue;
        vertices.push_back({x, {i, j, l}, planes.transpose().inverse()});
      }
    }
  }
  return vertices;
}

}  // namespace

const std::vector<GenericVertex>& generic_dop_vertices(int k) {
  // Never destroyed: a thread may still search while the program ends.
  static const auto& sets = *[] {
    auto* const all = new std::array<std::vector<GenericVertex>, kDopSizes.size()>;
    for (std::size_t i = 0; i < kDopSizes.size(); ++i)
      (*all)[i] = compute_vertices(dop_directions(kDopSizes[i]));
    return all;
  }();
  return sets[dop_size_index(k)];
}

}  // namespace glissade::collision
