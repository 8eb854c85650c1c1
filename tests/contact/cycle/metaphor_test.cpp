// The four ways to tie hand and part, and taking hold and letting go of it: a box above a floor.

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/geometry/mesh_generators.h>

#include "cycle/sliding_constants.h"
#include "held_part.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::kBoxSize;

constexpr double kRest = 0.02;  // of its middle above the floor

Isometry3d tilted_at(double x, double z, double angle = 0.0) {
  return Isometry3d(Eigen::Translation3d(x, 0.0, z)) * Eigen::AngleAxisd(angle, Vector3d::UnitY());
}

double angle_of(const Isometry3d& X) {
  return Eigen::AngleAxisd(X.linear()).angle();
}

Sliding box_above_floor(Metaphor metaphor, const Isometry3d& X_WV) {
  const auto floor =
      std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  const auto box =
      std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(geometry::make_box(kBoxSize, 300)));
  return {{{floor}}, box, X_WV, {.metaphor = metaphor}};
}

// From where the ghost is, straight.
void lead(Sliding& sliding, const Isometry3d& X_WG_to, int calls) {
  const Isometry3d X_WG_from = sliding.result().X_WG;
  const Eigen::Quaterniond q_from(X_WG_from.linear());
  for (int i = 1; i <= calls; ++i) {
    const double t = static_cast<double>(i) / calls;
    Isometry3d X_WG(q_from.slerp(t, Eigen::Quaterniond(X_WG_to.linear())));
    X_WG.translation() = (1.0 - t) * X_WG_from.translation() + t * X_WG_to.translation();
    sliding.advance(X_WG);
  }
}

TEST(Metaphor, HasItsNameOnTheCommandLine) {
  for (const std::string_view name : kMetaphorNames) {
    const std::optional<Metaphor> metaphor = metaphor_from_name(name);
    ASSERT_TRUE(metaphor.has_value()) << name;
    EXPECT_EQ(name_of(*metaphor), name);
  }
  EXPECT_EQ(metaphor_from_name("rubber-band-spring"), Metaphor::kRubberBandSpring);
  EXPECT_EQ(metaphor_from_name("incremental"), Metaphor::kIncremental);
  EXPECT_FALSE(metaphor_from_name("glue").has_value());
}

TEST(RubberBand, DoesNotTurnThePartInFreeSpace) {
  Sliding sliding = box_above_floor(Metaphor::kRubberBand, tilted_at(0.0, 0.1));
  lead(sliding, tilted_at(0.05, 0.12, 0.5), 100);
  EXPECT_EQ(sliding.result().state, SlidingState::kFree);
  EXPECT_EQ(sliding.result().X_WV.linear(), tilted_at(0.0, 0.1).linear());
  EXPECT_LT((sliding.result().X_WV.translation() - Vector3d(0.05, 0.0, 0.12)).norm(), 1e-15);
  EXPECT_EQ(sliding.lag().v, Vector3d::Zero());
}

TEST(RubberBand, LaysATiltedPartFlatAndGivesNoTorque) {
  constexpr double kTilt = 0.2;
  Sliding sliding = box_above_floor(Metaphor::kRubberBand, tilted_at(0.0, 0.06, kTilt));
  lead(sliding, tilted_at(0.0, kRest - 2e-3, kTilt), 200);
  lead(sliding, tilted_at(0.0, kRest - 2e-3, kTilt), 50);
  EXPECT_LT(angle_of(sliding.result().X_WV), 1e-3) << "the spring would hold it up";
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), kRest + sliding.margin(), 2.0 * sliding.margin());
  EXPECT_EQ(sliding.lag().w, Vector3d::Zero());
  EXPECT_NEAR(sliding.lag().v.z(), -2e-3, 4.0 * sliding.margin());
}

TEST(RubberBandSpring, HoldsATiltedPartUpByItsTorque) {
  constexpr double kTilt = 0.2;
  Sliding sliding = box_above_floor(Metaphor::kRubberBandSpring, tilted_at(0.0, 0.06, kTilt));
  lead(sliding, tilted_at(0.0, kRest, kTilt), 200);
  EXPECT_GT(angle_of(sliding.result().X_WV), 0.02);
  EXPECT_GT(sliding.lag().w.norm(), 0.02);
}

TEST(Incremental, DiscardsMotionBlockedByTheFloor) {
  Sliding sliding = box_above_floor(Metaphor::kIncremental, tilted_at(0.0, kRest + 1e-3));
  lead(sliding, tilted_at(0.0, kRest - 3e-3), 40);  // 1 mm to the floor, 3 mm refused
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), kRest, 2.0 * sliding.margin());
  EXPECT_NEAR(sliding.lag().v.z(), -1e-4, 2.0 * sliding.margin()) << "that of the last call alone";
  const double resting = sliding.result().X_WV.translation().z();
  lead(sliding, tilted_at(0.02, kRest - 2e-3), 40);  // back by 1 mm, and aside
  EXPECT_EQ(sliding.result().state, SlidingState::kFree) << "it lifts off at once";
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), resting + 1e-3, 2.0 * sliding.margin());
  EXPECT_NEAR(sliding.result().X_WV.translation().x(), 0.02, 1e-9);
}

TEST(Incremental, GraspAndReleaseAreItsClutch) {
  Sliding sliding = box_above_floor(Metaphor::kIncremental, tilted_at(0.0, 0.1));
  lead(sliding, tilted_at(0.1, 0.1), 100);
  const Isometry3d X_WV = sliding.result().X_WV;
  sliding.release();
  lead(sliding, tilted_at(-0.2, 0.3, 1.0), 10);
  EXPECT_EQ(sliding.result().X_WV.matrix(), X_WV.matrix()) << "nobody holds it";
  sliding.grasp(tilted_at(0.0, 0.1));
  EXPECT_EQ(sliding.result().X_WV.matrix(), X_WV.matrix());
  lead(sliding, tilted_at(0.1, 0.1), 100);
  EXPECT_NEAR(sliding.result().X_WV.translation().x(), 0.2, 1e-12) << "twice the reach of the hand";
}

TEST(Grasp, OffsetClosesAtLimitedSpeedWithoutForce) {
  Sliding sliding = box_above_floor(Metaphor::kForceFeedback, tilted_at(0.0, 0.1));
  sliding.release();
  EXPECT_EQ(sliding.result().state, SlidingState::kReleased);
  const Isometry3d X_WG = tilted_at(0.01, 0.11, 0.1);
  sliding.grasp(X_WG);
  Isometry3d X_WV = sliding.result().X_WV;
  int calls = 0;
  while (calls < 400 && sliding.result().X_WV.matrix() != X_WG.matrix()) {
    ASSERT_EQ(sliding.advance(X_WG).state, SlidingState::kFree);
    ASSERT_EQ(sliding.lag().v, Vector3d::Zero()) << "call " << calls;
    const geometry::Displacement d =
        geometry::displacement_between(X_WV, sliding.result().X_WV, sliding.part().p_Vref());
    ASSERT_LE(geometry::motion_bound(d, sliding.part().radius()), kClosing_m * (1.0 + 1e-9)) << "call " << calls;
    X_WV = sliding.result().X_WV;
    ++calls;
  }
  // 14 mm, and 0.1 rad of a radius of 62 mm.
  EXPECT_NEAR(calls, (std::sqrt(2.0) * 0.01 + 0.1 * sliding.part().radius()) / kClosing_m, 2.0);
}

// Steps as long as the greatest reach allows, half a turn around: what a step misses is searched in parts.
TEST(Metaphor, WithoutSpeedLimitCatchesUpAfterHalfATurnOfTheGhost) {
  Sliding sliding = box_above_floor(Metaphor::kRubberBandSpring, tilted_at(0.0, 0.2));
  for (int i = 1; i <= 60; ++i) {
    sliding.advance(tilted_at(2e-3 * i, 0.2, 3.0));
    ASSERT_GE(sliding.result().reach, 4.0 * sliding.margin()) << "call " << i;
  }
  EXPECT_LT(sliding.lag().v.norm(), 1e-9);
  EXPECT_LT(sliding.lag().w.norm(), 1e-9);
}

TEST(Grasp, OffsetBehindTheFloorRaisesTheForceAtTheSlew) {
  Sliding sliding = box_above_floor(Metaphor::kForceFeedback, tilted_at(0.0, kRest + 1e-3));
  sliding.release();
  const Isometry3d X_WG = tilted_at(0.0, kRest - 9e-3);
  sliding.grasp(X_WG);
  Vector3d error = Vector3d::Zero();
  for (int i = 0; i < 120; ++i) {
    sliding.advance(X_WG);
    ASSERT_LE((sliding.lag().v - error).norm(), kSlew_m * (1.0 + 1e-9)) << "call " << i;
    error = sliding.lag().v;
  }
  EXPECT_NEAR(error.z(), -9e-3, 2.0 * sliding.margin()) << "in the end as hard as any";
  sliding.grasp(tilted_at(0.0, kRest - 5e-3));
  EXPECT_EQ(sliding.lag().v, error) << "another hold of a part that is held keeps what pulls";
  sliding.advance(tilted_at(0.0, kRest - 5e-3));
  EXPECT_NEAR(sliding.lag().v.z(), error.z() + kClosing_m, 1e-9);
  sliding.release();
  EXPECT_EQ(sliding.lag().v, Vector3d::Zero());
}

TEST(Grasp, RepeatedReleaseAndGraspDoNotMoveAPressedPart) {
  Sliding sliding = box_above_floor(Metaphor::kForceFeedback, tilted_at(0.0, kRest + 1e-3));
  lead(sliding, tilted_at(0.0, kRest - 1e-3), 40);
  ASSERT_EQ(sliding.result().state, SlidingState::kResting);
  const Isometry3d X_WV = sliding.result().X_WV;
  for (int i = 0; i < 1000; ++i) {
    sliding.release();
    ASSERT_EQ(sliding.result().X_WV.matrix(), X_WV.matrix()) << i;
    ASSERT_EQ(sliding.lag().v, Vector3d::Zero()) << i;
    sliding.grasp(X_WV);
    // Held where it is, the part is free to go, though it lies on the floor.
    ASSERT_EQ(sliding.advance(X_WV).state, SlidingState::kFree) << i;
  }
  lead(sliding, tilted_at(0.0, kRest - 1e-3), 40);
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), X_WV.translation().z(), 2.0 * sliding.margin());
}

TEST(Grasp, InvalidPoseIsIgnored) {
  Sliding sliding = box_above_floor(Metaphor::kForceFeedback, tilted_at(0.0, 0.1));
  sliding.release();
  sliding.grasp(Isometry3d(Eigen::Scaling(2.0) * Isometry3d::Identity().matrix().topLeftCorner<3, 3>()));
  EXPECT_EQ(sliding.result().state, SlidingState::kReleased);
}

}  // namespace
}  // namespace glissade::contact
