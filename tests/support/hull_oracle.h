#pragma once

/// Exact test whether the hulls of two sets of points meet, independent of `separating_plane.h`: by CGAL's quadratic
/// programming, which is slow, or by verification of given proofs.

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::test_support {

/// The points of B are transformed in double precision; all further arithmetic is exact.
class HullOracle {
 public:
  HullOracle(std::span<const Eigen::Vector3d> points_A, std::span<const Eigen::Vector3d> points_B,
             const Eigen::Isometry3d& X_AB);

  /// A point of A and one of B, each in its own frame.
  using PointPair = std::array<Eigen::Vector3d, 2>;

  /// Whether A and B are certainly farther apart than `gap` metres along the normal `n_A` of any length: in quadruple
  /// precision with an error bound.
  bool proves_apart(const Eigen::Vector3d& n_A, double gap) const;

  /// Whether the origin lies inside the tetrahedron of the four differences, which proves that the hulls meet. Pairs of
  /// other points prove nothing.
  bool proves_meeting(const std::array<PointPair, 4>& pairs) const;

  /// The distance in metres, rounded, but 0 only if the hulls meet. Takes about a millisecond for hundreds of points.
  double distance() const;

  /// The vector from the closest point of A to that of B, in the frame of A, rounded. Zero if the hulls meet. Same cost
  /// as `distance`.
  Eigen::Vector3d difference() const;

 private:
  std::vector<Eigen::Vector3d> points_A_;
  std::vector<Eigen::Vector3d> points_B_;  ///< in the frame of A
  Eigen::Isometry3d X_AB_;
};

}  // namespace glissade::test_support
