#pragma once

/// Two convex hulls at a relative pose, with the memory of their last query: points of their Minkowski difference B −
/// A, and the plane between them.

#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/assert.h>
#include <glissade/collision/convex_hull.h>

#include "hull/gjk_simplex.h"

namespace glissade::collision {

/// The two hulls of one query. All lengths are in metres, all vectors in the frame of A.
class HullPair {
 public:
  HullPair(const ConvexHull& hull_A, const ConvexHull& hull_B, const Eigen::Isometry3d& X_AB, HullMemory& memory)
      : hull_A_(hull_A), hull_B_(hull_B), R_AB_(X_AB.linear()), p_AB_(X_AB.translation()), memory_(memory) {
    const double reach = hull_A.reach() + hull_B.reach() + p_AB_.lpNorm<1>();
    margin_ = hull_A.outside() + hull_B.outside() + kRoundingOfGap * reach;
    climbing_margin_ = margin_ + hull_A.climbing_error() + hull_B.climbing_error();
    memory_.gap = 0.0;
    memory_.loops = 0;
  }

  const ConvexHull& hull_A() const { return hull_A_; }
  const ConvexHull& hull_B() const { return hull_B_; }
  const Eigen::Matrix3d& R_AB() const { return R_AB_; }
  const Eigen::Vector3d& p_AB() const { return p_AB_; }
  HullMemory& memory() const { return memory_; }

  /// A gap between extreme corners is certain if it exceeds this margin, which covers rounding.
  double margin() const { return margin_; }
  /// The margin for corners found by climbing, which may have stopped too early.
  double climbing_margin() const { return climbing_margin_; }

  const Eigen::Vector3d& vertex_A(std::int32_t corner) const {
    return hull_A_.vertices()[static_cast<std::size_t>(corner)];
  }
  const Eigen::Vector3d& vertex_B(std::int32_t corner) const {
    return hull_B_.vertices()[static_cast<std::size_t>(corner)];
  }

  GjkPoint point(std::int32_t corner_A, std::int32_t corner_B) const {
    return {R_AB_ * vertex_B(corner_B) + p_AB_ - vertex_A(corner_A), corner_A, corner_B};
  }

  /// The point of B − A that is least along the unit vector n. It is certainly the least if it lies beyond the margin.
  /// The memory then has its corners.
  Eigen::Vector3d extreme(const Eigen::Vector3d& n) {
    GLISSADE_ASSERT(std::abs(n.squaredNorm() - 1.0) < 1e-9);
    const Eigen::Vector3d against_B = -(R_AB_.transpose() * n);
    memory_.corner_A = hull_A_.support(n, memory_.corner_A);
    memory_.corner_B = hull_B_.support(against_B, memory_.corner_B);
    const Eigen::Vector3d w = point(memory_.corner_A, memory_.corner_B).w;
    const double gap = n.dot(w);
    if (!(gap > margin_) || gap > climbing_margin_) return w;
    // Examines all corners only where an error of climbing would matter.
    memory_.corner_A = hull_A_.farthest(n);
    memory_.corner_B = hull_B_.farthest(against_B);
    return point(memory_.corner_A, memory_.corner_B).w;
  }

  /// Remembers the plane with normal n, which separates the extreme corners in memory by `gap`.
  void remember_plane(const Eigen::Vector3d& n, double gap) {
    memory_.n_A = n;
    memory_.n_gap_A = n;
    memory_.n_B = R_AB_.transpose() * n;
    memory_.reach_A = n.dot(vertex_A(memory_.corner_A));
    memory_.reach_B = -memory_.n_B.dot(vertex_B(memory_.corner_B));
    memory_.has_plane = true;
    memory_.gap = gap > climbing_margin_ ? gap - climbing_margin_ : gap - margin_;
  }

 private:
  // Relative to the sum of all coordinates that take part, each of which is rounded a few times.
  static constexpr double kRoundingOfGap = 1e-14;

  const ConvexHull& hull_A_;
  const ConvexHull& hull_B_;
  const Eigen::Matrix3d R_AB_;
  const Eigen::Vector3d p_AB_;
  HullMemory& memory_;
  double margin_;
  double climbing_margin_;
};

}  // namespace glissade::collision
