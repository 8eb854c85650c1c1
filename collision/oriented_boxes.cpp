#include "oriented_boxes.h"

#include <cmath>

namespace glissade::collision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool boxes_apart(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance) {
  const Matrix3d& R = frame.R_PQ;
  const Matrix3d abs_R = R.cwiseAbs();
  const Vector3d& p = frame.p_PQ;
  const double scale = base.inverse_radius();
  const Vector3d half_P = scale * base.half_size();
  const Vector3d half_Q = scale * other.half_size();
  const double margin = distance + 4.0 * frame.uncertainty;  // see docs/collision.md

  if (((p.cwiseAbs() - half_P - abs_R * half_Q).array() > margin).any()) return true;
  const Vector3d seen_from_Q = R.transpose() * p;
  if (((seen_from_Q.cwiseAbs() - half_Q - abs_R.transpose() * half_P).array() > margin).any()) return true;
  // Cross products of edges are hardly longer than 1, so that gaps along them are overrated within the margin at most.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      const double between = std::abs(p[k] * R(j, a) - p[j] * R(k, a));
      const double reach =
          half_P[j] * abs_R(k, a) + half_P[k] * abs_R(j, a) + half_Q[b] * abs_R(i, c) + half_Q[c] * abs_R(i, b);
      if (between - reach > margin) return true;
    }
  }
  return false;
}

}  // namespace glissade::collision
