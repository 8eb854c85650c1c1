/// What a device has exerted between two states.

#include "envelope/given_wrenches.h"

#include <gtest/gtest.h>

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

/// A hand that moves along x at 1 m/s from 0 to 100 ms.
double work_until_100(GivenWrenches& given) {
  const auto moved = [](double share) { return Vector3d(0.1 * share, 0.0, 0.0); };
  const auto turned = [](double /*share*/) { return Vector3d(0.0, 0.0, 0.0); };
  return given.work(milliseconds(0), milliseconds(100), moved, turned);
}

TEST(GivenWrenches, EachActsUntilTheNext) {
  GivenWrenches given(milliseconds(0), milliseconds(1000));
  given.give(milliseconds(0), {1.0, 5.0, 0.0}, Vector3d::Zero());
  given.give(milliseconds(30), {2.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 1.0 * 0.03 + 2.0 * 0.07, 1e-12);
}

TEST(GivenWrenches, EachActsAfterTheDelayOfTheDevice) {
  GivenWrenches given(milliseconds(20), milliseconds(1000));
  given.give(milliseconds(0), {1.0, 0.0, 0.0}, Vector3d::Zero());
  given.give(milliseconds(30), {2.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 1.0 * 0.03 + 2.0 * 0.05, 1e-12);
  const auto moved = [](double share) { return Vector3d(0.1 * share, 0.0, 0.0); };
  given.give(milliseconds(100), {4.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(given.work(milliseconds(100), milliseconds(200), moved, moved), 2.0 * 0.02 + 4.0 * 0.08, 1e-12)
      << "the newest of before still acts";
}

TEST(GivenWrenches, WorkToComeIsThatOfDelayedWrenches) {
  GivenWrenches given(milliseconds(40), milliseconds(1000));
  for (int ms = 0; ms <= 30; ++ms)
    given.give(milliseconds(ms), {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
  EXPECT_NEAR(given.work_to_come(milliseconds(30), {0.5, 0.0, 0.0}, {0.0, 0.1, 0.0}), 0.03 * (0.5 + 0.2), 1e-12);
  EXPECT_NEAR(given.work_to_come(milliseconds(60), {0.5, 0.0, 0.0}, {0.0, 0.1, 0.0}), 0.01 * (0.5 + 0.2), 1e-12);
  EXPECT_EQ(given.work_to_come(milliseconds(70), {0.5, 0.0, 0.0}, {0.0, 0.1, 0.0}), 0.0);
}

TEST(GivenWrenches, NoneActsLongerThanTheWatchdogAllows) {
  GivenWrenches given(milliseconds(0), milliseconds(10));
  given.give(milliseconds(0), {1.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 1.0 * 0.01, 1e-12);
}

TEST(GivenWrenches, TorqueDoesWorkOnRotations) {
  GivenWrenches given(milliseconds(0), milliseconds(1000));
  given.give(milliseconds(0), Vector3d::Zero(), {0.0, 0.0, 3.0});
  const auto still = [](double /*share*/) { return Vector3d(0.0, 0.0, 0.0); };
  const auto turned = [](double share) { return Vector3d(0.0, 0.0, 0.5 * share * share); };
  EXPECT_NEAR(given.work(milliseconds(0), milliseconds(50), still, turned), 1.5, 1e-12);
}

TEST(GivenWrenches, AreRememberedForADelayHoweverLong) {
  GivenWrenches given(milliseconds(600), milliseconds(10));
  for (int ms = 0; ms < 700; ++ms)
    given.give(milliseconds(ms - 600), {ms < 50 ? 1.0 : 2.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 1.0 * 0.05 + 2.0 * 0.05, 1e-12);
}

TEST(GivenWrenches, AreAllRememberedAtAHighUpdateRate) {
  constexpr std::chrono::microseconds kPeriod(20);
  GivenWrenches given(milliseconds(50), milliseconds(50), kPeriod);
  for (std::chrono::microseconds now(-50'000); now < milliseconds(50); now += kPeriod)
    given.give(now, {1.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 0.1, 1e-12);
}

TEST(GivenWrenches, ManyWrenchesBetweenTwoStatesDisplaceNone) {
  GivenWrenches given(milliseconds(0), milliseconds(10));
  given.give(milliseconds(0), {1.0, 0.0, 0.0}, Vector3d::Zero());
  for (int i = 1; i < 100'000; ++i)
    given.give(milliseconds(5) + std::chrono::microseconds(i), Vector3d::Zero(), Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 1.0 * 5.001e-3, 1e-9);
}

TEST(GivenWrenches, WrenchGivenAtAnEarlierTimeReplacesTheLast) {
  GivenWrenches given(milliseconds(0), milliseconds(1000));
  given.give(milliseconds(50), {1.0, 0.0, 0.0}, Vector3d::Zero());
  given.give(milliseconds(20), {2.0, 0.0, 0.0}, Vector3d::Zero());
  EXPECT_NEAR(work_until_100(given), 2.0 * 0.05, 1e-12);
}

}  // namespace
}  // namespace glissade::devices
