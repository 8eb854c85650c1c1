/// The emulated Inverse3: the hand yields to the force, and the filters of the service change it.

#include "haply/emulated_arm.h"

#include <gtest/gtest.h>

#include <glissade/bridges/haply_emulator.h>

#include "haply/smooth_turn.h"

namespace glissade::bridges {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST(EmulatedArm, MovesTheHandByForceOverStiffness) {
  EmulatedArm arm(resting_haply_hand(), {}, nanoseconds(0));
  const Vector3d start = arm.state().X_WH.translation();
  for (int i = 1; i <= 3000; ++i)
    arm.advance(i * milliseconds(1), {2.0, 0.0, 0.0}, 0.0, true);
  // The wearer's arm has 400 N/m.
  EXPECT_NEAR(arm.state().X_WH.translation().x() - start.x(), 2.0 / 400.0, 2e-5);
}

TEST(EmulatedArm, HasTheDampingAndTheScaleOfTheService) {
  EmulatedArm arm(resting_haply_hand(), {.force_scale = 0.5}, nanoseconds(0));
  const double start = arm.state().X_WH.translation().x();
  double taken_away_Ns = 0.0;
  for (int i = 1; i <= 500; ++i) {
    arm.advance(i * milliseconds(1), {2.0, 0.0, 0.0}, 10.0, true);
    taken_away_Ns += (0.5 * 2.0 - arm.force().x()) * 1e-3;
  }
  const double way = arm.state().X_WH.translation().x() - start;
  EXPECT_GT(way, 0.001) << "the hand moves";
  EXPECT_NEAR(taken_away_Ns, 0.5 * 10.0 * way, 0.02 * 0.5 * 10.0 * way);
}

TEST(OscillationGate, PassesASteadyForceAndWeakensOneThatTurnsRound) {
  OscillationGate gate;
  for (int i = 0; i < 1000; ++i)
    EXPECT_EQ(gate.pass({1, 0, 0}, i * milliseconds(1), 0.3), 1.0);
  double pass = 1.0;
  for (int i = 1000; i < 2000; ++i)
    pass = gate.pass({i / 10 % 2 == 0 ? 1.0 : -1.0, 0, 0}, i * milliseconds(1), 0.3);  // 50 Hz
  EXPECT_NEAR(pass, 0.7, 1e-12);
}

// The handle turns by 5 rad/s and is measured 60 times a second.
TEST(SmoothTurn, HasNoJumpBetweenTwoMeasurements) {
  constexpr double kRate = 5.0;
  SmoothTurn turn;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  double fastest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double measured_at_s = std::floor(i * 1e-3 * 60.0) / 60.0;
    turn.advance(Eigen::Quaterniond(Eigen::AngleAxisd(kRate * measured_at_s, Vector3d::UnitZ())), 1e-3);
    fastest = std::max(fastest, turn.orientation().angularDistance(last) / 1e-3);
    last = turn.orientation();
  }
  EXPECT_LT(fastest, 10.0) << "rad/s; the steps themselves are 83 rad/s";
  const double angle = Eigen::AngleAxisd(turn.orientation()).angle();
  EXPECT_NEAR(angle, kRate * (0.5 - 0.015 - 1.0 / 120.0), kRate * 0.01) << "behind by the time constant";
}

}  // namespace
}  // namespace glissade::bridges
