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

  /// How far B must move along the unit vector `axis` for the bounding box of A and that of the turned B to be apart.
  double box_separation(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& axis) const;

  /// A place along `axis` where the turned B comes as close to A as `gap`: there it is just further away than that, and
  /// a hair nearer to the centre just not. Nothing when B is not that close even at the centre.
  std::optional<double> approach(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& axis, double gap);

 private:
  const collision::DopTree& tree_A_;
  const collision::DopTree& tree_B_;
  std::mt19937_64 random_;
  collision::QueryWorkspace workspace_;
};

Eigen::Isometry3d pose(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB);

}  // namespace glissade::bench
