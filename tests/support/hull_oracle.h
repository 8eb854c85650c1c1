#pragma once

/// Whether the hulls of two sets of points meet, in exact arithmetic and independent of `separating_plane.h`: by CGAL's
/// quadratic programming, which is slow, or by proofs that somebody claims and that are verified here.

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::test_support {

/// The points of B are transformed in double precision; from there on nothing is rounded.
class HullOracle {
 public:
  HullOracle(std::span<const Eigen::Vector3d> points_A, std::span<const Eigen::Vector3d> points_B,
             const Eigen::Isometry3d& X_AB);

  /// A point of A and one of B, each in its own frame.
  using PointPair = std::array<Eigen::Vector3d, 2>;

  /// Whether A and B are certainly further apart than `gap` metres along this normal, which need not be of unit length:
  /// quadruple precision with a bound of its error.
  bool proves_apart(const Eigen::Vector3d& n_A, double gap) const;

  /// Whether the origin is inside of four differences of points, which proves that the hulls meet.
  /// Pairs that are not of the points prove nothing.
  bool proves_meeting(const std::array<PointPair, 4>& pairs) const;

  /// The distance in metres; it is rounded, but it is 0 only if the hulls meet. For hundreds of points about a
  /// millisecond.
  double distance() const;

  /// From the point of A that is nearest to B to the point of B nearest to it, in the frame of A; rounded. Zero if they
  /// meet. Cost as of `distance`.
  Eigen::Vector3d difference() const;

 private:
  std::vector<Eigen::Vector3d> points_A_;
  std::vector<Eigen::Vector3d> points_B_;  ///< in the frame of A
  Eigen::Isometry3d X_AB_;
};

}  // namespace glissade::test_support
