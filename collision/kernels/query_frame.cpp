#include "kernels/query_frame.h"

#include <stdexcept>

#include <glissade/geometry/displacement.h>

namespace glissade::collision {

namespace {

/// Far more than two bodies within ±1e9 m are apart.
constexpr double kGreatestTranslation_m = 1e12;
/// Distances in radii are single precision, and are squared.
constexpr double kGreatestDistance_radii = 1e18;

}  // namespace

QueryFrame::QueryFrame(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB)
    : base_is_A(base_is_first(tree_A, tree_B)) {
  const Eigen::Matrix3d& R_AB = X_AB.linear();
  rotation_defect = geometry::rotation_defect(R_AB);
  if (!(rotation_defect < 1e-3) || !geometry::is_right_handed(R_AB) ||
      !(X_AB.translation().lpNorm<1>() <= kGreatestTranslation_m)) {
    throw std::invalid_argument("the pose X_AB of a query is not a rotation and a translation within 1e12 m");
  }
  if (!(tree_A.options() == tree_B.options())) {
    throw std::invalid_argument("the two trees of a query were built with different options");
  }
  const DopTree& base = base_is_A ? tree_A : tree_B;
  const DopTree& other = base_is_A ? tree_B : tree_A;
  base_radius = base.radius();
  const double scale = base.inverse_radius();
  ratio = other.radius() * scale;

  const Eigen::Vector3d centers = (X_AB * tree_B.center() - tree_A.center()) * scale;
  if (base_is_A) {
    R_MN = R_AB;
    p_MN = centers;
  } else {
    R_MN = R_AB.transpose();
    p_MN = -(R_MN * centers);
  }
  if (!(p_MN.lpNorm<1>() <= kGreatestDistance_radii)) {
    throw std::invalid_argument("the meshes of a query are more than 1e18 times as far apart as they are large");
  }

  // Sums of coordinates bound lengths.
  const double magnitude = X_AB.translation().lpNorm<1>() + tree_A.center().lpNorm<1>() + tree_B.center().lpNorm<1>();
  const double reach = magnitude * scale + 1.0 + ratio + p_MN.lpNorm<1>();
  uncertainty = (0x1p-48 + 2.0 * rotation_defect) * reach;
}

bool QueryFrame::spheres_apart(double tolerance) const {
  if (!(tolerance >= 0.0)) throw std::invalid_argument("a query's tolerance or distance is negative or not a number");
  // `uncertainty` and the factor below cover the rounding of the sum itself.
  const double reach = 1.0 + ratio + in_base_radii(tolerance) + uncertainty;
  return p_MN.squaredNorm() > reach * reach * (1.0 + 1e-12);
}

}  // namespace glissade::collision
