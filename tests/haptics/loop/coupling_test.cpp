#include <gtest/gtest.h>

#include <glissade/haptics/coupling.h>

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;

constexpr contact::CouplingStiffness kCouplingStiffness{1000.0, 10.0};
constexpr CouplingDamping kDamping{5.0, 0.05};

TEST(Coupling, PullsTheHandFromTheGhostToThePart) {
  const contact::Wrench wrench =
      contact::spring_wrench(kCouplingStiffness, {Vector3d(0.0, 0.0, -2e-3), Vector3d(0.01, 0.0, 0.0)});
  EXPECT_TRUE(wrench.f.isApprox(Vector3d(0.0, 0.0, 2.0)));  // the ghost is 2 mm below the part
  EXPECT_TRUE(wrench.t.isApprox(Vector3d(-0.1, 0.0, 0.0)));
}

TEST(Coupling, MovingAWrenchToAnotherPointAddsTheForcesLever) {
  const contact::Wrench at_tip{Vector3d(0.0, 0.0, 2.0), Vector3d(0.1, 0.0, 0.0)};
  const contact::Wrench at_hand = contact::about_point(at_tip, Vector3d(0.3, 0.0, 0.0), Vector3d(0.1, 0.0, 0.0));
  EXPECT_TRUE(at_hand.f.isApprox(at_tip.f));
  EXPECT_TRUE(at_hand.t.isApprox(Vector3d(0.1, -0.4, 0.0)));  // (0.2, 0, 0) × (0, 0, 2)
}

TEST(Coupling, DampsOnlyAlongTheSpring) {
  const contact::Wrench spring{Vector3d(0.0, 0.0, 2.0), Vector3d::Zero()};
  const contact::Wrench sliding = damper_wrench(kDamping, spring, Vector3d(0.3, 0.0, 0.0), Vector3d::Zero());
  EXPECT_EQ(sliding.f, Vector3d::Zero());
  const contact::Wrench pressing = damper_wrench(kDamping, spring, Vector3d(0.3, 0.0, -0.1), Vector3d::Zero());
  EXPECT_TRUE(pressing.f.isApprox(Vector3d(0.0, 0.0, 0.5)));
}

TEST(Coupling, DampingNeverPullsTowardsAContact) {
  const contact::Wrench spring{Vector3d(0.0, 0.0, 0.2), Vector3d(0.0, 0.001, 0.0)};
  const contact::Wrench leaving = damper_wrench(kDamping, spring, Vector3d(0.0, 0.0, 10.0), Vector3d(0.0, 10.0, 0.0));
  EXPECT_TRUE((spring.f + leaving.f).isZero(1e-15));
  EXPECT_TRUE((spring.t + leaving.t).isZero(1e-15));
}

TEST(Coupling, WithoutASpringThereIsNoDamping) {
  const contact::Wrench damping = damper_wrench(kDamping, {}, Vector3d(1.0, 2.0, 3.0), Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(damping.f, Vector3d::Zero());
  EXPECT_EQ(damping.t, Vector3d::Zero());
}

}  // namespace
}  // namespace glissade::haptics
