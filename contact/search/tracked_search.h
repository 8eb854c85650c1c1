#pragma once

/// A search for candidates, and how the bodies have moved since its poses.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "scene/contact_scene.h"
#include "search/approach.h"
#include "search/candidate_search.h"

namespace glissade::contact {

struct TrackedSearch {
  CandidateRequest request;
  CandidateSet set;                             ///< the answer; a thread may still be working on it
  std::vector<BoundedMotion> motions;           ///< of each body
  double ahead = 0.0;                           ///< metres: the look-ahead
  double step = 0.0;                            ///< metres: of a step at whose middle it is made; else 0
  double drift = 0.0;                           ///< metres: bound of how much nearer two bodies have come
  double least_drift = 0.0;                     ///< metres: so far
  std::vector<Eigen::Isometry3d> X_WB_nearest;  ///< of each mover, when the drift was least
  bool is_there = false;                        ///< requested

  /// To be called when the movers have been placed at X_WB.
  void follow(const ContactScene& scene, std::span<const Eigen::Isometry3d> X_WB);

  /// The largest reach (metres) around the present poses within which all pairs are known.
  double covered() const { return is_there ? request.range.radius - drift : -std::numeric_limits<double>::infinity(); }
  bool covers(double reach) const { return reach <= covered(); }
  /// The same on straight ways of all points from there to where the drift is `drift_at_end` (metres): how far the
  /// difference of two points is from that at the search is greatest at an end.
  double covered_up_to(double drift_at_end) const {
    return is_there ? request.range.radius - std::max(drift, drift_at_end) : covered();
  }
  /// Whether the parts still come nearer to its poses, as far as its answer has been taken ahead of them.
  bool is_approached() const { return drift <= least_drift; }
  /// Whether it is time for the next search.
  bool is_being_left() const;
  /// Whether the parts go away from the poses of a search whose answer has not been taken.
  bool is_in_vain() const;

  /// Lower bound (metres) of the present distance of two triangles or boxes that the unit vector n_W separated by
  /// `distance`. If n_W is zero, that direction is unknown.
  double still_apart(const BodyPair& bodies, double distance, const Eigen::Vector3d& n_W) const {
    const BoundedMotion& of_obstacle = motions[static_cast<std::size_t>(bodies.obstacle)];
    const BoundedMotion& of_part = motions[static_cast<std::size_t>(bodies.part)];
    const Eigen::Vector3d v_W = of_part.v_W - of_obstacle.v_W;
    const double apart = n_W.isZero(0.0) ? -v_W.norm() : n_W.dot(v_W);
    return distance + apart - of_part.turn - of_obstacle.turn;
  }
  /// Calls `visit` with the pairs that may be within `reach` (metres) now, nearest first at the poses of the search.
  template <typename Pair, typename Visit>
  void visit_within(const std::vector<Pair>& pairs, double reach, const Visit& visit) const {
    for (const Pair& pair : pairs) {
      if (pair.distance > reach + drift) return;  // as are all that follow
      if (still_apart(pair.bodies, pair.distance, pair.n_W) <= reach) visit(pair);
    }
  }
};

}  // namespace glissade::contact
