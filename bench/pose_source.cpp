#include "pose_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade::bench {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

AlignedBox3d bounds(const geometry::TriangleMesh& mesh, const Matrix3d& R) {
  AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices)
    box.extend(R * vertex);
  return box;
}

}  // namespace

Isometry3d pose(const Matrix3d& R_AB, const Vector3d& p_AB) {
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.linear() = R_AB;
  X_AB.translation() = p_AB;
  return X_AB;
}

PoseSource::PoseSource(const collision::DopTree& tree_A, const collision::DopTree& tree_B, std::uint64_t seed)
    : tree_A_(tree_A), tree_B_(tree_B), random_(seed) {}

double PoseSource::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

Vector3d PoseSource::direction() {
  const double z = uniform(-1.0, 1.0);
  const double angle = uniform(-std::numbers::pi, std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Uniform over all rotations (Shoemake 1992).
Matrix3d PoseSource::rotation() {
  const double share = uniform(0.0, 1.0);
  const double a = uniform(-std::numbers::pi, std::numbers::pi);
  const double b = uniform(-std::numbers::pi, std::numbers::pi);
  const double r = std::sqrt(1.0 - share);
  const double s = std::sqrt(share);
  return Eigen::Quaterniond(s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)).toRotationMatrix();
}

double PoseSource::box_separation(const Matrix3d& R_AB, const Vector3d& axis) const {
  const AlignedBox3d box_A = bounds(tree_A_.mesh(), Matrix3d::Identity());
  const AlignedBox3d box_B = bounds(tree_B_.mesh(), R_AB);
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (axis[i] == 0.0) continue;
    const double way = axis[i] > 0.0 ? box_A.max()[i] - box_B.min()[i] : box_A.min()[i] - box_B.max()[i];
    distance = std::min(distance, way / axis[i]);
  }
  return distance;
}

std::optional<double> PoseSource::approach(const Matrix3d& R_AB, const Vector3d& axis, double gap) {
  const auto close_at = [&](double t) {
    return collision::intersects(tree_A_, tree_B_, pose(R_AB, t * axis), workspace_, gap);
  };
  double close = 0.0;
  double apart = 1.01 * box_separation(R_AB, axis) + 2.0 * gap;
  while (close_at(apart))  // the boxes may be closer in other directions
    apart += 2.0 * gap;
  if (!close_at(close)) {  // B may fit into A: it is close to A's shell only
    constexpr double kStep = 0.01;
    const double outside = apart;
    for (close = outside; !close_at(close);) {
      apart = close;
      close -= kStep * outside;
      if (close < 0.0) return std::nullopt;  // before it is close to the shell beyond the centre
    }
  }
  while (apart - close > 1e-10 * apart) {
    const double middle = 0.5 * (close + apart);
    (close_at(middle) ? close : apart) = middle;
  }
  return apart;
}

}  // namespace glissade::bench
