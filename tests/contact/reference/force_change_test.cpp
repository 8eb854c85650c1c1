// How fast the force can change: no faster than the ghost where the free space is convex, and by a bounded amount a
// millisecond everywhere.

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using test_support::kBoxSize;
using test_support::turn_from_to;

constexpr unsigned kForceChangeSeed = 47;

geometry::TriangleMesh sheet_of_800(const Vector3d& normal) {
  return geometry::transformed(geometry::make_plate({0.5, 0.5}, 800),
                               Isometry3d(turn_from_to(Vector3d::UnitZ(), normal)));
}

std::shared_ptr<const SlidingPart> box(std::int64_t triangles) {
  return std::make_shared<SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box(kBoxSize, triangles)));
}

/// ‖ξ‖_K, whose square is twice the energy of the spring.
double norm_in(const CouplingStiffness& stiffness, const geometry::Displacement& d) {
  return std::sqrt(stiffness.translational * d.v.squaredNorm() + stiffness.rotational * d.w.squaredNorm());
}

geometry::Displacement difference(const geometry::Displacement& a, const geometry::Displacement& b) {
  return {a.v - b.v, a.w - b.w};
}

TEST(ForceChange, InAConvexCornerTheForceChangesNoMoreThanTheGhostMoves) {
  RecordProperty("seed", static_cast<int>(kForceChangeSeed));
  SCOPED_TRACE("seed " + std::to_string(kForceChangeSeed));
  std::mt19937 random(kForceChangeSeed);
  std::normal_distribution<double> normal;
  const geometry::TriangleMesh corner = geometry::merge(
      std::vector{sheet_of_800(Vector3d::UnitX()), sheet_of_800(Vector3d::UnitY()), sheet_of_800(Vector3d::UnitZ())});
  const Vector3d seat = 0.5 * kBoxSize;
  Vector3d ghost = seat + Vector3d::Constant(1e-3);
  Sliding sliding({{std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(corner))}}, box(12),
                  Isometry3d(Eigen::Translation3d(ghost)), {.metaphor = Metaphor::kRubberBandSpring});
  geometry::Displacement before = sliding.lag();
  constexpr int kMilliseconds = test_support::affordable(3000);
  int in_contact = 0;
  for (int i = 0; i < kMilliseconds; ++i) {
    // A walk that is drawn back to the corner, 0.1 to 1 mm at a time.
    const Vector3d step = 2e-4 * Vector3d(normal(random), normal(random), normal(random)) + 0.03 * (seat - ghost);
    ghost += step;
    const SlidingResult& result = sliding.advance(Isometry3d(Eigen::Translation3d(ghost)));
    in_contact += result.pushing > 0 ? 1 : 0;
    const geometry::Displacement now = sliding.lag();
    const double change = norm_in(sliding.stiffness(), difference(now, before));
    const double ghost_change = norm_in(sliding.stiffness(), {step, Vector3d::Zero()});
    // A cycle that moves less than a twentieth of the margin, or before one that would, is the last of its call.
    const double unsettled = std::sqrt(sliding.stiffness().translational) * 0.1 * sliding.margin();
    ASSERT_LE(change, 1.001 * ghost_change + unsettled) << "after " << i << " ms";
    before = now;
  }
  EXPECT_GT(in_contact, kMilliseconds / 2) << "else little has been tested";
}

TEST(ForceChange, WhereABoxSnapsOffARimTheForceFallsNoFasterThanTheSlewAllows) {
  const auto plate =
      std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.2, 0.2}, 100)));
  Sliding sliding({{plate}}, box(12), Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.021)));
  Vector3d ghost(0.0, 0.0, 0.021);
  geometry::Displacement before = sliding.lag();
  double greatest_lag = 0.0;
  for (int i = 0; i < 1200; ++i) {
    const Vector3d step = i < 100 ? Vector3d(0.0, 0.0, -6e-5) : Vector3d(2e-4, 0.0, 0.0);
    ghost += step;
    sliding.advance(Isometry3d(Eigen::Translation3d(ghost)));
    const geometry::Displacement now = sliding.lag();
    greatest_lag = std::max(greatest_lag, now.v.norm());
    ASSERT_LE((now.v - before.v).norm(), kSlew_m + step.norm() + 1e-12) << "after " << i << " ms";
    before = now;
  }
  EXPECT_GT(greatest_lag, 4e-3) << "it has been pressed";
  EXPECT_EQ(sliding.result().state, SlidingState::kFree) << "it has left the plate";
}

}  // namespace
}  // namespace glissade::contact
