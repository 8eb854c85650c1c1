/// Smoothed flex values of a hand that holds something.

#include "life/steady_fingers.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::grasping {
namespace {

constexpr double kDegreeOfNoise = std::numbers::pi / 180.0;

TEST(SteadyFingers, AttenuateNoise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 2.0 * kDegreeOfNoise);
  SteadyFingers fingers;
  fingers.begin(std::vector{0.5});
  double squares = 0.0;
  constexpr int kCount = 10000;
  for (int ms = 0; ms < kCount; ++ms)
    squares += std::pow(fingers.follow(std::vector{0.5 + noise(random)}, 1.0)[0] - 0.5, 2.0);
  EXPECT_LT(std::sqrt(squares / kCount), 0.5 * kDegreeOfNoise);
}

TEST(SteadyFingers, ConvergeToTheTarget) {
  SteadyFingers fingers;
  fingers.begin(std::vector{0.0});
  for (int ms = 0; ms < 200; ++ms)
    fingers.follow(std::vector{1.0 * kDegreeOfNoise}, 1.0);
  EXPECT_NEAR(fingers.follow(std::vector{1.0 * kDegreeOfNoise}, 1.0)[0], 1.0 * kDegreeOfNoise, 1e-4 * kDegreeOfNoise);
}

// A hand that opens in a tenth of a second.
TEST(SteadyFingers, AreAtMostTenMillisecondsLateWhenTheyMoveFast) {
  constexpr double kRate = 12e-3;  // rad/ms
  SteadyFingers fingers;
  fingers.begin(std::vector{0.0});
  for (int ms = 1; ms <= 100; ++ms)
    EXPECT_GE(fingers.follow(std::vector{kRate * ms}, 1.0)[0], kRate * (ms - 11)) << ms;
}

}  // namespace
}  // namespace glissade::grasping
