#pragma once

/// Whether a part that stands still could have moved: the independent judge of jammed ticks.

#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include <glissade/haptics/sliding_result.h>
#include "search/candidate_pairs.h"
#include "sliding_scenes.h"
#include "solver/projection.h"

namespace glissade::bench {

/// Not thread-safe. Knows nothing of the method that moves the part.
class JamCheck {
 public:
  explicit JamCheck(const test_support::SlidingScene& scene);

  /// Whether the part at X_WV, which wants to go by `wanted`, can do a step of kTrialStep_m at least towards that: what
  /// all contacts within reach allow of it, contacts being held at a distance of `hold` metres, is as long; the pose
  /// at its end collides with nothing; and the energy of the coupling is less there.
  bool could_move(const Eigen::Isometry3d& X_WV, const geometry::Displacement& wanted,
                  const haptics::CouplingStiffness& stiffness, double hold);

  static constexpr double kTrialStep_m = 20e-6;

 private:
  geometry::Displacement allowed(const Eigen::Isometry3d& X_WV, const geometry::Displacement& wanted,
                                 const haptics::CouplingStiffness& stiffness, double hold);
  bool collides(const Eigen::Isometry3d& X_WV);

  const test_support::SlidingScene& scene_;
  haptics::ContactScene bodies_;
  haptics::CandidatePairs candidates_;
  std::vector<haptics::CandidatePair> pairs_;
  std::vector<haptics::Contact> contacts_;
  std::vector<haptics::ConstraintRow> rows_;
  haptics::ProjectionSolver solver_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::bench
