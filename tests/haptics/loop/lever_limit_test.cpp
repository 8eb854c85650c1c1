/// The passive stiffness at a distance from the device, where a number is zero or not finite. (`passivity_test`
/// compares the others with eigenvalues.)

#include "loop/lever_limit.h"

#include <limits>

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

constexpr LeverLimit kAtHand{.translational = 2000.0, .rotational = 10.0, .lever = 0.0};

TEST(LeverLimit, AtTheHandEachSpringHasItsOwnLimit) {
  EXPECT_DOUBLE_EQ(kAtHand.share_of({1000.0, 5.0}), 1.0);
  EXPECT_DOUBLE_EQ(kAtHand.share_of({4000.0, 5.0}), 0.5);
  EXPECT_DOUBLE_EQ(kAtHand.share_of({1000.0, 40.0}), 0.25);
  EXPECT_DOUBLE_EQ(kAtHand.share_of_damping({1000.0, 5.0}, {4000.0, 5.0}), 0.25);
}

TEST(LeverLimit, ZeroStiffnessIsPassiveEverywhere) {
  EXPECT_EQ(kAtHand.share_of({0.0, 0.0}), 1.0);
  EXPECT_EQ((LeverLimit{0.0, 0.0, 0.3}.share_of({0.0, 0.0})), 1.0);
}

TEST(LeverLimit, ADeviceThatCannotTurnBearsNoSpringAtADistance) {
  EXPECT_EQ((LeverLimit{2000.0, 0.0, 0.1}.share_of({1000.0, 0.0})), 0.0);
  EXPECT_EQ((LeverLimit{0.0, 10.0, 0.1}.share_of({1000.0, 5.0})), 0.0);
}

TEST(LeverLimit, ShareIsZeroForNonFiniteNumbers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((LeverLimit{2000.0, 10.0, kInfinity}.share_of({1000.0, 5.0})), 0.0);
  EXPECT_EQ((LeverLimit{2000.0, 10.0, kNan}.share_of({1000.0, 5.0})), 0.0);
  EXPECT_EQ((LeverLimit{2000.0, 10.0, 0.1}.share_of({kNan, 5.0})), 0.0);
}

TEST(LeverLimit, SpringAtTheLimitLeavesNoDamping) {
  const LeverLimit limit{2000.0, 10.0, 0.1};
  const double share = limit.share_of({2000.0, 5.0});
  EXPECT_NEAR(limit.share_of_damping({share * 2000.0, share * 5.0}, {100.0, 1.0}), 0.0, 1e-12);
}

}  // namespace
}  // namespace glissade::haptics
