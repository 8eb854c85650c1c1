#include "query/oriented_boxes.h"

#include <cmath>

namespace glissade::collision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool boxes_apart(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance) {
  const Matrix3d& R = frame.R_MN;
  const Matrix3d abs_R = R.cwiseAbs();
  const Vector3d& p = frame.p_MN;
  const double scale = base.inverse_radius();
  const Vector3d half_M = scale * base.half_size();
  const Vector3d half_N = scale * other.half_size();
  const double margin = distance + 4.0 * frame.uncertainty;  // see docs/collision.md

  if (((p.cwiseAbs() - half_M - abs_R * half_N).array() > margin).any()) return true;
  const Vector3d seen_from_N = R.transpose() * p;
  if (((seen_from_N.cwiseAbs() - half_N - abs_R.transpose() * half_M).array() > margin).any()) return true;
  // Cross products of edges exceed length 1 by so little that the margin covers the overestimated gap.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      const double between = std::abs(p[k] * R(j, a) - p[j] * R(k, a));
      const double reach =
          half_M[j] * abs_R(k, a) + half_M[k] * abs_R(j, a) + half_N[b] * abs_R(i, c) + half_N[c] * abs_R(i, b);
      if (between - reach > margin) return true;
    }
  }
  return false;
}

}  // namespace glissade::collision
