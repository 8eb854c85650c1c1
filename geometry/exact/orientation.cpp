#include "exact/orientation.h"

#include <cmath>
#include <limits>

#include "exact/expansion.h"

namespace glissade::geometry {
namespace {

using Eigen::Vector3d;

// Half a unit in the last place of 1. The factors below are those of Shewchuk's first-stage bounds (3 + 16u)u and
// (7 + 56u)u, rounded up.
constexpr double kRoundoff = std::numeric_limits<double>::epsilon() / 2.0;
constexpr double kBound2d = 3.001 * kRoundoff;
constexpr double kBound3d = 7.001 * kRoundoff;

int sign_of(double value) {
  return (value > 0.0) - (value < 0.0);
}

// ax·by − bx·ay of exact differences.
Expansion<16> exact_minor(const Expansion<2>& ax, const Expansion<2>& ay, const Expansion<2>& bx,
                          const Expansion<2>& by) {
  return ax * by - bx * ay;
}

int exact_orient3d_sign(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Expansion<2> ax = exact_difference(a.x(), d.x());
  const Expansion<2> ay = exact_difference(a.y(), d.y());
  const Expansion<2> az = exact_difference(a.z(), d.z());
  const Expansion<2> bx = exact_difference(b.x(), d.x());
  const Expansion<2> by = exact_difference(b.y(), d.y());
  const Expansion<2> bz = exact_difference(b.z(), d.z());
  const Expansion<2> cx = exact_difference(c.x(), d.x());
  const Expansion<2> cy = exact_difference(c.y(), d.y());
  const Expansion<2> cz = exact_difference(c.z(), d.z());
  return (exact_minor(bx, by, cx, cy) * az + exact_minor(cx, cy, ax, ay) * bz + exact_minor(ax, ay, bx, by) * cz)
      .sign();
}

int exact_orient2d_sign(const Vector3d& a, const Vector3d& b, const Vector3d& c, int u, int v) {
  return exact_minor(exact_difference(a[u], c[u]), exact_difference(a[v], c[v]), exact_difference(b[u], c[u]),
                     exact_difference(b[v], c[v]))
      .sign();
}

}  // namespace

int orient3d_sign(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const double ax = a.x() - d.x();
  const double ay = a.y() - d.y();
  const double az = a.z() - d.z();
  const double bx = b.x() - d.x();
  const double by = b.y() - d.y();
  const double bz = b.z() - d.z();
  const double cx = c.x() - d.x();
  const double cy = c.y() - d.y();
  const double cz = c.z() - d.z();

  const double bxcy = bx * cy;
  const double cxby = cx * by;
  const double cxay = cx * ay;
  const double axcy = ax * cy;
  const double axby = ax * by;
  const double bxay = bx * ay;
  const double determinant = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
  const double permanent = (std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
                           (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
                           (std::abs(axby) + std::abs(bxay)) * std::abs(cz);
  if (std::abs(determinant) > kBound3d * permanent) {
    return sign_of(determinant);
  }
  return exact_orient3d_sign(a, b, c, d);
}

int orient2d_sign(const Vector3d& a, const Vector3d& b, const Vector3d& c, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double left = (a[u] - c[u]) * (b[v] - c[v]);
  const double right = (a[v] - c[v]) * (b[u] - c[u]);
  const double determinant = left - right;
  if (std::abs(determinant) > kBound2d * (std::abs(left) + std::abs(right))) {
    return sign_of(determinant);
  }
  return exact_orient2d_sign(a, b, c, u, v);
}

}  // namespace glissade::geometry
