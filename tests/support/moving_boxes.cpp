#include "moving_boxes.h"

#include <algorithm>
#include <cmath>

#include <glissade/geometry/displacement.h>

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr double kGapRounding_m = 1e-14;
constexpr int kMostStretchHalvings = 40;

/// Half the extent of the box along a unit vector in the world.
double extent(const Vector3d& half, const Isometry3d& X_WB, const Vector3d& n_W) {
  return (X_WB.linear().transpose() * n_W).cwiseAbs().dot(half);
}

/// From box a to box b along the unit vector; negative where their shadows on it overlap.
double gap_along(const Vector3d& n_W, const Vector3d& half_a, const Isometry3d& X_WA, const Vector3d& half_b,
                 const Isometry3d& X_WB) {
  const double between = n_W.dot(X_WB.translation() - X_WA.translation());
  return between - extent(half_a, X_WA, n_W) - extent(half_b, X_WB, n_W);
}

geometry::Displacement way_of(const MovingBox& box) {
  return geometry::displacement_between(box.X_WB_from, box.X_WB_to, Vector3d::Zero());
}

/// How far a corner is from the chord of its way in such a fraction of the motion, at most.
double bend(const MovingBox& box, double fraction) {
  const double angle = fraction * way_of(box).w.norm();
  return angle * angle * box.half.norm() / 8.0;
}

/// One direction for the whole stretch if it serves; otherwise one for each half of it.
bool stay_apart(const MovingBox& a, const MovingBox& b, double begin, double end, int halvings) {
  const double middle = 0.5 * (begin + end);
  const std::optional<Vector3d> n = separating_axis(a.half, a.at(middle), b.half, b.at(middle));
  if (!n) return false;
  const double needed = bend(a, end - begin) + bend(b, end - begin) + kGapRounding_m;
  const auto has_gap = [&](double t) { return gap_along(*n, a.half, a.at(t), b.half, b.at(t)) > needed; };
  if (has_gap(begin) && has_gap(end)) return true;
  if (halvings == kMostStretchHalvings) return false;
  return stay_apart(a, b, begin, middle, halvings + 1) && stay_apart(a, b, middle, end, halvings + 1);
}

}  // namespace

Isometry3d MovingBox::at(double t) const {
  if (t == 0.0) return X_WB_from;
  if (t == 1.0) return X_WB_to;
  return geometry::displaced(X_WB_from, Vector3d::Zero(), way_of(*this).scaled(t));
}

std::optional<Vector3d> separating_axis(const Vector3d& half_a, const Isometry3d& X_WA, const Vector3d& half_b,
                                        const Isometry3d& X_WB) {
  std::optional<Vector3d> widest;
  double greatest = kGapRounding_m;
  const auto try_axis = [&](const Vector3d& axis) {
    constexpr double kParallel = 1e-9;
    const double length = axis.norm();
    if (length < kParallel) return;  // of edges that are parallel: the faces have this axis
    for (const double sign : {1.0, -1.0}) {
      const Vector3d n_W = sign / length * axis;
      const double gap = gap_along(n_W, half_a, X_WA, half_b, X_WB);
      if (gap <= greatest) continue;
      greatest = gap;
      widest = n_W;
    }
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(X_WA.linear().col(i));
    try_axis(X_WB.linear().col(i));
    for (int j = 0; j < 3; ++j)
      try_axis(X_WA.linear().col(i).cross(X_WB.linear().col(j)));
  }
  return widest;
}

bool stay_apart(const MovingBox& a, const MovingBox& b) {
  const double distance = (b.X_WB_from.translation() - a.X_WB_from.translation()).norm();
  const double moved = way_of(a).v.norm() + way_of(b).v.norm();
  if (distance > moved + a.half.norm() + b.half.norm() + kGapRounding_m) return true;
  return stay_apart(a, b, 0.0, 1.0, 0);
}

}  // namespace glissade::test_support
