#include "pipeline/world_box.h"

namespace glissade::collision {

// A vertex is c + d with |d_i| ≤ h_i and |d| ≤ r, and R d reaches |R| h along the axes, and r, R being a rotation.
//
// What queries see is not quite that: R is a rotation to 1e-12 only, and they take R_A transposed for its inverse,
// which puts a point of A that is u from A's origin off by as much of |u|; and they round sums of the coordinates of
// both objects. Each object's box grows by its own share of both, many times over.
Eigen::AlignedBox3d world_box(const DopTree& tree, const Eigen::Isometry3d& X_WO) {
  const Eigen::Vector3d center = X_WO * tree.center();
  const Eigen::Vector3d turned = X_WO.linear().cwiseAbs() * tree.half_size();
  const double reach = tree.center().lpNorm<1>() + tree.radius();
  const double padding = 0x1p-46 * X_WO.translation().lpNorm<1>() + 4e-12 * reach;
  const Eigen::Vector3d half = turned.array().min(tree.radius()) + padding;
  return {center - half, center + half};
}

}  // namespace glissade::collision
