#include "clasp/slide_past.h"

#include <algorithm>
#include <cmath>

namespace glissade::grasping {

geometry::Displacement slide_past(const geometry::Displacement& wanted, std::span<const ContactPlane> planes,
                                  double radius, std::vector<double>& forces, double compliance) {
  constexpr int kSweeps = 60;
  constexpr double kDone = 1e-3;
  const double per_turn = 1.0 / (radius * radius);
  geometry::Displacement d = wanted;
  forces.assign(planes.size(), 0.0);
  double size = wanted.v.norm() + radius * wanted.w.norm();
  for (const ContactPlane& plane : planes)
    size = std::max(size, -plane.room);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Eigen::Vector3d& n = planes[i].n_W;
      const Eigen::Vector3d turning = planes[i].r_W.cross(n);
      const double stiffness = 1.0 + per_turn * turning.squaredNorm();
      const double short_of = -planes[i].room - (n.dot(d.v) + turning.dot(d.w));
      const double push = std::max(-forces[i], (short_of - compliance * forces[i]) / (stiffness + compliance));
      forces[i] += push;
      d.v += push * n;
      d.w += push * per_turn * turning;
      change = std::max(change, std::abs(push));
    }
    if (change <= kDone * size) break;
  }
  return d;
}

}  // namespace glissade::grasping
