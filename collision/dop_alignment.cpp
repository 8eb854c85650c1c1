#include "dop_alignment.h"

#include <algorithm>
#include <cmath>

#include "generic_dop.h"

namespace glissade::collision {
namespace {

constexpr double kWeightUnit = 32768.0;
constexpr double kLargestOffset = 32767.0;

}  // namespace

void DopAlignment::align(const DopDirections& directions, int k, const QueryFrame& frame) {
  slabs = directions.slabs;
  const auto& vertices = generic_dop_vertices(k);
  for (int i = 0; i < slabs; ++i) {
    const Eigen::Vector3d& b = directions.unit[static_cast<std::size_t>(i)];
    const Eigen::Vector3d direction_Q = frame.R_PQ.transpose() * b;
    double most = 0.0;
    const GenericVertex* extremal = &vertices.front();
    double sign = 1.0;
    for (const GenericVertex& vertex : vertices) {
      const double reach = direction_Q.dot(vertex.position);
      if (std::abs(reach) > most) {
        most = std::abs(reach);
        extremal = &vertex;
        sign = reach < 0.0 ? -1.0 : 1.0;
      }
    }

    const Eigen::Vector3d weights = sign * frame.ratio * (extremal->weights_of_direction * direction_Q);
    Eigen::Vector3d residual = frame.ratio * direction_Q;  // what the rounded, non-negative weights leave
    std::array<std::int16_t, 3> rounded{};
    for (std::size_t l = 0; l < 3; ++l) {
      const int own = extremal->half_spaces[l];
      const int h = sign > 0.0 ? own : directions.opposite(own);
      rounded[l] = static_cast<std::int16_t>(
          std::clamp(std::round(weights[static_cast<Eigen::Index>(l)] * kWeightUnit), 0.0, kLargestOffset));
      residual -= rounded[l] / kWeightUnit * directions.half_space(h);
      half_space[l][static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(h);
    }

    // In grid steps. Rounding: of the direction, over the whole of Q; of three products, half a step each; of what
    // double precision did; the rest is for this sum itself.
    const double padding = kGridRadius * (residual.norm() + frame.uncertainty) + 1.5 + 0.01;
    const double center = kGridRadius * b.dot(frame.p_PQ);
    const double above = std::ceil(center + padding);
    const double below = std::ceil(-center + padding);
    const bool representable = std::max(above, below) <= kLargestOffset;
    const auto row = 8 * static_cast<std::size_t>(i);
    for (std::size_t lane = 0; lane < 8; ++lane) {
      // A slab too far away to be told from others never separates.
      offset[row + lane] = static_cast<std::int16_t>(!representable ? kLargestOffset : lane < kWidth ? below : above);
      for (std::size_t l = 0; l < 3; ++l)
        weight[l][row + lane] = representable ? rounded[l] : std::int16_t{0};
    }
    for (std::size_t l = 0; l < 3; ++l) {
      const int h = half_space[l][static_cast<std::size_t>(i)];
      const auto quarter = [&](int half) {
        return static_cast<std::uint8_t>(half < slabs ? 2 * half : 2 * (half - slabs) + 1);
      };
      source[l][2 * static_cast<std::size_t>(i)] = quarter(directions.opposite(h));
      source[l][2 * static_cast<std::size_t>(i) + 1] = quarter(h);
    }
  }
  for (auto row = static_cast<std::size_t>(slabs); row < kMostRows; ++row) {
    for (std::size_t lane = 8 * row; lane < 8 * row + 8; ++lane) {
      offset[lane] = static_cast<std::int16_t>(kLargestOffset);
      for (std::size_t l = 0; l < 3; ++l)
        weight[l][lane] = 0;
    }
    for (std::size_t l = 0; l < 3; ++l)
      source[l][2 * row] = source[l][2 * row + 1] = 0;
  }
}

}  // namespace glissade::collision
