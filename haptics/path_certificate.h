#pragma once

/// The proof that a step of the parts stays clear of everything on its whole way, not only at its end. Two sheets
/// without thickness can pass through each other without any pose in between that collides; a path certificate rules
/// that out.

#include <array>
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
  std::int32_t part;
  std::int32_t part_triangle;
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
};

/// Proves triangle pairs apart along displacements of the parts. Not thread-safe.
class PathCertificate {
 public:
  /// The surroundings must outlive this object.
  explicit PathCertificate(const Surroundings& surroundings);

  /// Tries to prove all of `pairs` apart while every part goes from where it is placed along its displacement, all of
  /// them at once; `displacements` has one for each. Replaces `failures` by the pairs it could not prove.
  ///
  /// A pair must keep the floor of its bodies; one that starts the step nearer keeps 0.95 of its distance, and one that
  /// touches cannot be proved apart at all. It is apart over a stretch of the path if one
  /// direction separates it at both ends by more than the curvature of the paths can take away in between, the sum of
  /// |w|² ρ / 8 over the two; otherwise the stretch is halved, up to five times.
  /// Returns whether there are no failures.
  bool prove(std::span<const Displacement> displacements, std::span<const CandidatePair> pairs,
             std::vector<UncertifiedPair>& failures);

  /// Metres: of bodies where they are placed, less than this is no certain distance.
  double certain_distance() const;

 private:
  /// Both triangles of a pair at one moment of the path.
  struct Moment {
    collision::TrianglePoints obstacle;
    collision::TrianglePoints part;
  };
  /// A stretch of the path.
  struct Stretch {
    const Moment& begin;
    const Moment& end;
    double curvature;  ///< what it can take from a gap, metres
  };

  /// The path is cut into 2^5 parts; a moment is the number of one of their ends.
  static constexpr int kMoments = 32;

  /// The poses of a part on its way.
  struct Path {
    const ContactBody* body;
    Eigen::Vector3d p_Vref;
    double radius;
    Displacement displacement;
    std::array<Eigen::Isometry3d, kMoments + 1> X_WV_at;
    std::array<bool, kMoments + 1> known{};  ///< which of them have been computed
  };

  bool stands_still(const CandidatePair& pair) const;
  bool prove_pair(const CandidatePair& pair, Eigen::Vector3d& n_start);
  bool prove_stretch(const CandidatePair& pair, int begin, int end, double floor);
  bool separates(const Eigen::Vector3d& n, const Stretch& stretch, double floor) const;
  Moment moment_of(const CandidatePair& pair, int moment);
  collision::TrianglePoints triangle_at(std::int32_t body, std::int32_t triangle, int moment);
  double curvature_loss(const CandidatePair& pair, int begin, int end) const;

  const Surroundings& surroundings_;
  std::int32_t first_part_;
  double reach_of_obstacles_ = 0.0;  // metres from the origin
  double rounding_ = 0.0;            // metres: distances below this are not certain
  std::vector<Path> paths_;          // one for each part
};

}  // namespace glissade::haptics
