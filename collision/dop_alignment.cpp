#include "dop_alignment.h"

#include <algorithm>
#include <cmath>

#include "generic_dop.h"
#include "round_up.h"

namespace glissade::collision {
namespace {

const GenericVertex& extremal_vertex(const Eigen::Vector3d& direction) {
  const auto& vertices = generic_dop_vertices();
  return *std::max_element(vertices.begin(), vertices.end(), [&](const GenericVertex& u, const GenericVertex& v) {
    return direction.dot(u.position) < direction.dot(v.position);
  });
}

}  // namespace

DopAlignment::DopAlignment(const Eigen::Isometry3d& X_AB, double largest_coordinate_A, double largest_coordinate_B) {
  for (int i = 0; i < kDopDirections; ++i) {
    const Eigen::Vector3d b = dop_direction(i);
    const Eigen::Vector3d direction_B = X_AB.linear().transpose() * b;
    const GenericVertex& vertex = extremal_vertex(direction_B);
    const Eigen::Vector3d exact_weights = vertex.weights_of_direction * direction_B;

    Row& row = rows_[static_cast<std::size_t>(i)];
    Eigen::Vector3d residual = direction_B;  // what the rounded, non-negative weights leave of the direction
    double weight_sum = 0.0;
    for (int l = 0; l < 3; ++l) {
      const auto slot = static_cast<std::size_t>(l);
      row.half_spaces[slot] = static_cast<std::uint8_t>(vertex.half_spaces[slot]);
      row.weights[slot] = static_cast<float>(std::max(0.0, exact_weights[l]));
      const auto weight = static_cast<double>(row.weights[slot]);
      residual -= weight * dop_direction(vertex.half_spaces[slot]);
      weight_sum += weight;
    }

    // Rounding: of the residual direction; of the four products and sums in single precision, each at most 2^-24 of
    // terms that are at most 3·(largest coordinate) a weight or the offset itself; and of everything done in double
    // precision (projections, transformed vertices), which 2^-48 covers generously.
    const double translation = b.dot(X_AB.translation());
    const double translation_magnitude = b.cwiseAbs().dot(X_AB.translation().cwiseAbs());
    const double terms = 3.0 * weight_sum * largest_coordinate_B + translation_magnitude;
    const double padding = residual.lpNorm<1>() * largest_coordinate_B + std::ldexp(8.0 * terms, -24) +
                           std::ldexp(3.0 * largest_coordinate_A + terms, -48);
    row.offset = round_up_to_float(translation + padding);
  }
}

std::array<float, kDopDirections> separation_thresholds(double distance) {
  std::array<float, kDopDirections> thresholds;
  for (int i = 0; i < kDopDirections; ++i) {
    thresholds[static_cast<std::size_t>(i)] = round_up_to_float(distance * dop_direction(i).norm());
  }
  return thresholds;
}

}  // namespace glissade::collision
