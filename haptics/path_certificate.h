#pragma once

/// The proof that a step of the part stays clear of everything on its whole way, not only at its end. Two sheets
/// without thickness can pass through each other without any pose in between that collides; a path certificate rules
/// that out.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/triangle_intersection.h>
#include <glissade/haptics/candidate_pairs.h>
#include <glissade/haptics/motion.h>

namespace glissade::haptics {

/// A pair that could not be proved apart, and the direction that held it apart at the start of the step.
struct UncertifiedPair {
  std::int32_t obstacle;
  std::int32_t obstacle_triangle;
  std::int32_t part_triangle;
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
};

/// Proves triangle pairs apart along displacements of the part. Not thread-safe.
class PathCertificate {
 public:
  /// `floor` (metres) is the distance every pair must keep; a pair that starts the step nearer keeps 0.95 of its
  /// distance, and one that touches cannot be proved apart at all.
  /// Obstacles and part must outlive this object.
  PathCertificate(std::span<const Obstacle> obstacles, const SlidingPart& part_V, double floor);

  /// Tries to prove all of `pairs` apart on the displacement `d` from X_WV; replaces `failures` by those it could not.
  /// A pair is apart over a stretch of the path if one direction separates it at both ends by more than the path's
  /// curvature can take away in between, |w|² ρ / 8; otherwise the stretch is halved, up to five times.
  /// Returns whether there are no failures.
  bool prove(const Eigen::Isometry3d& X_WV, const Displacement& d, std::span<const CandidatePair> pairs,
             std::vector<UncertifiedPair>& failures);

 private:
  bool prove_pair(const CandidatePair& pair, Eigen::Vector3d& n_start);
  bool prove_stretch(const CandidatePair& pair, int begin, int end, double floor);
  /// Whether n separates the pair by `floor` on the whole stretch.
  bool separates(const Eigen::Vector3d& n, const collision::TrianglePoints& part_begin,
                 const collision::TrianglePoints& part_end, double curvature, double floor) const;
  collision::TrianglePoints part_triangle_at(std::int32_t triangle, int moment);
  /// What the curvature of the path between two moments can take from a gap, metres.
  double curvature_loss(int begin, int end) const;

  /// The path is cut into 2^5 parts; a moment is the number of one of their ends.
  static constexpr int kMoments = 32;

  std::span<const Obstacle> obstacles_;
  const SlidingPart& part_V_;
  double floor_;
  double rounding_;  // metres: distances below this are not certain
  Eigen::Isometry3d X_WV_start_;
  Displacement displacement_;
  std::array<Eigen::Isometry3d, kMoments + 1> X_WV_at_;
  std::array<bool, kMoments + 1> known_{};  // which of them have been computed
  collision::TrianglePoints obstacle_;      // of the pair under proof
};

}  // namespace glissade::haptics
