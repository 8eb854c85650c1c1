#include "pipeline/world_box.h"

namespace glissade::collision {

// A vertex is c + d with |d_i| ≤ h_i and |d| ≤ r. R d extends by at most |R| h along the axes and, because R is a
// rotation, by at most r.
//
// Queries differ from that in two ways. R is a rotation to 1e-12 only, and they take the transpose of R_A for its
// inverse, which moves a point of A at distance |u| from A's origin by up to 1e-12 |u|. They also round sums of the
// coordinates of both objects. The box of each object grows by its own share of both, many times over.
Eigen::AlignedBox3d world_box(const DopTree& tree, const Eigen::Isometry3d& X_WO) {
  const Eigen::Vector3d center = X_WO * tree.center();
  const Eigen::Vector3d turned = X_WO.linear().cwiseAbs() * tree.half_size();
  const double reach = tree.center().lpNorm<1>() + tree.radius();
  const double padding = 0x1p-46 * X_WO.translation().lpNorm<1>() + 4e-12 * reach;
  const Eigen::Vector3d half = turned.array().min(tree.radius()) + padding;
  return {center - half, center + half};
}

}  // namespace glissade::collision
