// How fast the force may change with a ghost that also turns, for random parts (force_change_test.cpp has the simple
// case).
//
// Let G and V be the ghost and the visible part, and F = K (G − V) in the metric ‖ξ‖² = ξᵀ K ξ; for wrenches the norm
// is ‖F‖² = Fᵀ K⁻¹ F, so that ‖K ξ‖ = ‖ξ‖. Were poses vectors and the free ones a convex set, V would be the projection
// of G on it, and G − V the rest. For two ghosts, the rest at each makes an obtuse angle with the way to the other
// projection: ⟨G₁ − V₁, V₂ − V₁⟩ ≤ 0 and ⟨G₂ − V₂, V₁ − V₂⟩ ≤ 0, in sum ⟨ΔG − ΔV, ΔV⟩ ≥ 0. Hence
// ‖ΔG‖² = ‖ΔV‖² + 2 ⟨ΔG − ΔV, ΔV⟩ + ‖ΔG − ΔV‖² ≥ ‖ΔG − ΔV‖², and ‖ΔF‖ ≤ ‖ΔG‖.
// The free poses are about convex where the obstacles are half-spaces: a floor, a groove, a corner. Rotations bend what
// is flat: along a contact the rest changes by −c/(1 − c) of ΔG, c being the lag times the curvature of the contact,
// which is no more than ΔG up to c = 1/2. Rotation vectors of a lag of a radians stretch the ghost's turns by up to
// (a/2)/sin(a/2), below 1.0005 for the lags here.
// About a convex obstacle, however, the free poses are not convex: the part snaps from one facet to the next, and with
// it the force. Under force feedback the slew limits that, in any scene.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "convex_shapes.h"
#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;
using test_support::RandomNumbers;
using test_support::turn;

constexpr double kMostRatio = 1.001;

/// A ghost that wanders at random, and the greatest change of force in a tick for the change of the ghost in it.
class RandomMotion {
 public:
  RandomMotion(Sliding& sliding, std::uint64_t seed) : sliding_(sliding), random_(seed) {}

  /// The ghost goes about `X_middle` in straight legs of 40 ms, not further off than by `reach` metres along each axis
  /// and by `largest_turn` radians.
  void run(const Isometry3d& X_middle, double reach, double largest_turn, int legs) {
    for (int leg = 0; leg < legs; ++leg) {
      const Isometry3d X_to = pose(X_middle.translation() + random_.point(reach),
                                   turn(random_.uniform(-largest_turn, largest_turn), random_.direction()) *
                                       Eigen::Quaterniond(X_middle.linear()));
      geometry::Displacement stretch = sliding_.lag();
      Isometry3d X_WG = sliding_.result().X_WG;
      test_support::lead(sliding_, X_to, 40, [&](const SlidingResult& result) {
        look(stretch, X_WG, result);
        stretch = sliding_.lag();
        X_WG = result.X_WG;
      });
    }
  }

  double greatest_ratio = 0.0;   ///< ‖ΔF‖ / ‖ΔG‖
  double greatest_excess = 0.0;  ///< |Δf|/k_t, beyond the motion bound of the ghost, metres
  int in_contact = 0;            ///< ticks

 private:
  void look(const geometry::Displacement& stretch_previous, const Isometry3d& X_WG_previous,
            const SlidingResult& result) {
    const CouplingStiffness& K = sliding_.stiffness();
    const double radius = sliding_.part().radius();
    const geometry::Displacement stretch = sliding_.lag();
    const geometry::Displacement change{stretch.v - stretch_previous.v, stretch.w - stretch_previous.w};
    const geometry::Displacement ghost =
        geometry::displacement_between(X_WG_previous, result.X_WG, sliding_.part().p_Vref());
    greatest_ratio = std::max(greatest_ratio, test_support::length_in(K, change) / test_support::length_in(K, ghost));
    greatest_excess = std::max(greatest_excess, change.v.norm() - geometry::motion_bound(ghost, radius));
    in_contact += result.pushing > 0 ? 1 : 0;
  }

  Sliding& sliding_;
  RandomNumbers random_;
};

/// Blocks of 0.6 m whose faces meet in the origin: one makes a floor, two a groove, three a corner.
std::vector<Obstacle> half_spaces(int count) {
  constexpr double kEdge = 0.6;
  std::vector<Obstacle> obstacles;
  for (const Vector3d& axis : std::vector<Vector3d>{Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()}) {
    if (count-- == 0) break;
    const Vector3d middle = -0.5 * kEdge * axis + 0.25 * kEdge * (Vector3d::Ones() - axis);
    obstacles.push_back(test_support::obstacle_of(geometry::make_box(Vector3d::Constant(kEdge), 12), pose(middle)));
  }
  return obstacles;
}

TEST(ForceChangeOfATurningPart, BoundedByTheGhostMotionInConvexFreeSpace) {
  for (int seed = 1; seed <= std::max(3, test_support::affordable(12)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    const auto part = test_support::part_of(test_support::random_convex_mesh(random, 0.03));
    const int faces = 1 + seed % 3;
    const Isometry3d X_start = pose(Vector3d::Constant(0.09), Eigen::Quaterniond(random.rotation()));
    Sliding sliding(half_spaces(faces), part, X_start, {.metaphor = Metaphor::kRubberBandSpring});
    // The ghost draws the part in, just ahead of it, until all faces hold it.
    Isometry3d X_middle = X_start;
    for (int i = 0; i < 2000 && sliding.result().pushing < faces; ++i) {
      X_middle = sliding.result().X_WV;
      X_middle.translation() -= Vector3d::Constant(1e-4);
      sliding.advance(X_middle);
    }
    ASSERT_GE(sliding.result().pushing, faces);
    RandomMotion motion(sliding, static_cast<std::uint64_t>(seed));
    motion.run(X_middle, 3e-3, 0.02, 25);
    EXPECT_GT(motion.in_contact, 150);
    EXPECT_LE(motion.greatest_ratio, kMostRatio);
  }
}

TEST(ForceChangeOfATurningPart, BoundedByTheSlewUnderForceFeedback) {
  // A hull among spheres, which its ghost goes right through.
  double greatest_excess = 0.0;
  for (int seed = 1; seed <= std::max(1, test_support::affordable(6)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 8; ++i) {
      const Vector3d p = 0.1 * Vector3d(i % 2 == 0 ? 1 : -1, i / 2 % 2 == 0 ? 1 : -1, i / 4 == 0 ? 1 : -1);
      obstacles.push_back(test_support::obstacle_of(geometry::make_sphere(0.07, 300), pose(p)));
    }
    const auto part = test_support::part_of(test_support::random_convex_mesh(random, 0.03));
    Sliding sliding(obstacles, part, Isometry3d::Identity());
    RandomMotion motion(sliding, static_cast<std::uint64_t>(seed));
    motion.run(Isometry3d::Identity(), 0.1, 0.5, 40);
    EXPECT_GT(motion.in_contact, 150);
    EXPECT_LE(motion.greatest_excess, kSlew_m * (1.0 + 1e-6));
    greatest_excess = std::max(greatest_excess, motion.greatest_excess);
  }
  if (test_support::kSanitized) return;  // not every hull tries the limit
  EXPECT_GT(greatest_excess, 0.25 * kSlew_m) << "the limit was never tried";
}

}  // namespace
}  // namespace glissade::contact
