#pragma once

/// Independent check for jams: whether a part that stands still could have moved.

#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/projection.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/spring.h>

#include "search/candidate_pairs.h"
#include "sweeps/sliding_scenes.h"

namespace glissade::bench {

/// Not thread-safe. Independent of the method that moves the part.
class JamCheck {
 public:
  explicit JamCheck(const test_support::SlidingScene& scene);

  /// Whether a part at X_WV with the lag `wanted` can move by at least kTrialStep_m. The step is the projection of
  /// `wanted` on all contacts within reach, which hold the part at a distance of `hold` metres. It must be long enough,
  /// lead to a pose without collision, and reduce the energy of the coupling.
  bool could_move(const Eigen::Isometry3d& X_WV, const geometry::Displacement& wanted,
                  const contact::CouplingStiffness& stiffness, double hold);

  static constexpr double kTrialStep_m = 20e-6;

 private:
  geometry::Displacement allowed(const Eigen::Isometry3d& X_WV, const geometry::Displacement& wanted,
                                 const contact::CouplingStiffness& stiffness, double hold);
  bool collides(const Eigen::Isometry3d& X_WV);

  const test_support::SlidingScene& scene_;
  contact::ContactScene bodies_;
  contact::CandidatePairs candidates_;
  std::vector<contact::TrianglesOfBodies> pairs_;
  std::vector<contact::Contact> contacts_;
  std::vector<contact::ConstraintRow> rows_;
  contact::ProjectionSolver solver_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::bench
