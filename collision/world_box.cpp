#include <glissade/collision/world_box.h>

#include "rotation_defect.h"

namespace glissade::collision {

// In exact arithmetic, a vertex is c + d with |d_i| ≤ h_i and |d| ≤ r, and R d reaches |R| h along the axes, and |row|
// r, whatever R is. The norm of RᵀR and that of RRᵀ are the same, so a row is no longer than 1 + defect.
//
// What queries see is not quite that: they take R_A transposed for its inverse, which puts a point of A that is u from
// A's origin off by at most its defect times |u|; and they round sums of the coordinates of both objects. Each object's
// box grows by its own share of both, many times over.
Eigen::AlignedBox3d world_box(const DopTree& tree, const Eigen::Isometry3d& X_WO) {
  const Eigen::Matrix3d& R = X_WO.linear();
  const double defect = rotation_defect(R);
  const Eigen::Vector3d center = X_WO * tree.center();
  const Eigen::Vector3d turned = R.cwiseAbs() * tree.half_size();
  const double sphere = (1.0 + defect) * tree.radius();
  const double reach = tree.center().lpNorm<1>() + tree.radius();
  const double padding = 0x1p-46 * (X_WO.translation().lpNorm<1>() + reach) + 2.0 * defect * reach;
  const Eigen::Vector3d half = turned.array().min(sphere) + padding;
  return {center - half, center + half};
}

}  // namespace glissade::collision
