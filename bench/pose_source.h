#pragma once

/// Random poses of an object B about an object A, both centred on their origins.

#include <optional>
#include <random>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

namespace glissade::bench {

class PoseSource {
 public:
  /// The trees must live longer. Equal seeds give equal poses.
  PoseSource(const collision::DopTree& tree_A, const collision::DopTree& tree_B, std::uint64_t seed);

  double uniform(double low, double high);
  Eigen::Vector3d direction();
  Eigen::Matrix3d rotation();

  /// Distance along the unit vector `axis` at which the bounding boxes of A and of the rotated B come apart.
  double box_separation(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& axis) const;

  /// Distance along `axis` at which the rotated B reaches the gap `gap` to A: there it is just farther away, and
  /// slightly nearer to the centre it is not. Nothing if B is farther away at the centre and, in steps of a hundredth,
  /// all the way to it.
  std::optional<double> approach(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& axis, double gap);

 private:
  const collision::DopTree& tree_A_;
  const collision::DopTree& tree_B_;
  std::mt19937_64 random_;
  collision::QueryWorkspace workspace_;
};

Eigen::Isometry3d pose(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB);

}  // namespace glissade::bench
