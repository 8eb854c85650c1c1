#include "clasp/root_slide.h"

#include <algorithm>
#include <cmath>

namespace glissade::grasping {

geometry::Displacement slide_root(const geometry::Displacement& wanted, const ClosingRows& rows, double radius,
                                  std::vector<double>& forces) {
  constexpr int kSweeps = 60;
  constexpr double kDone = 1e-3;
  const double per_turn = 1.0 / (radius * radius);
  geometry::Displacement d = wanted;
  forces.assign(rows.count(), 0.0);
  const double size = wanted.v.norm() + radius * wanted.w.norm();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t row = 0; row < rows.count(); ++row) {
      const Eigen::Vector3d& n = rows.n_W(row);
      const Eigen::Vector3d turning = rows.r_W(row).cross(n);
      const double stiffness = 1.0 + per_turn * turning.squaredNorm();
      const double short_of = -rows.room(row) - (n.dot(d.v) + turning.dot(d.w));
      const double push = std::max(-forces[row], short_of / stiffness);
      forces[row] += push;
      d.v += push * n;
      d.w += push * per_turn * turning;
      change = std::max(change, std::abs(push));
    }
    if (change <= kDone * size) break;
  }
  return d;
}

}  // namespace glissade::grasping
