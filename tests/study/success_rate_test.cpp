/// The exact interval of a share, beside its definition.

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/study/success_rate.h>

namespace glissade::study {
namespace {

/// The probability of at most k successes of n.
double at_most(int k, int n, double p) {
  double sum = 0.0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

TEST(SuccessRate, EachBoundLeavesOutATailOfTwoAndAHalfPercent) {
  const Rate rate = success_rate(37, 120);
  EXPECT_DOUBLE_EQ(rate.share, 37.0 / 120.0);
  EXPECT_NEAR(at_most(37, 120, rate.greatest), 0.025, 1e-9);
  EXPECT_NEAR(1.0 - at_most(36, 120, rate.least), 0.025, 1e-9);
}

TEST(SuccessRate, WithoutFailureTheBoundIsTheRuleOfThree) {
  const Rate rate = success_rate(1000, 1000);
  EXPECT_EQ(rate.greatest, 1.0);
  EXPECT_NEAR(rate.least, std::pow(0.025, 1.0 / 1000.0), 1e-12);
  EXPECT_EQ(success_rate(0, 10).least, 0.0);
}

TEST(SuccessRate, OneStratumIsTheWholeStudy) {
  for (const int successes : {0, 37, 119, 120}) {
    const Rate rate = stratified_rate({{1.0, static_cast<double>(successes), 120}});
    EXPECT_NEAR(rate.least, success_rate(successes, 120).least, 1e-9);
    EXPECT_NEAR(rate.greatest, success_rate(successes, 120).greatest, 1e-9);
  }
}

/// The same outcomes, known to lie in two halves, leave less doubt.
TEST(SuccessRate, StrataAreWeighted) {
  const Rate rate = stratified_rate({{0.25, 200.0, 200}, {0.75, 0.0, 100}});
  EXPECT_DOUBLE_EQ(rate.share, 0.25);
  EXPECT_LT(rate.greatest - rate.least, 0.05);
  EXPECT_GT(rate.greatest, 0.25 + 0.75 * 0.01);
}

TEST(SuccessRate, ImpossibleCountsAreRefused) {
  EXPECT_THROW(success_rate(0, 0), std::invalid_argument);
  EXPECT_THROW(success_rate(3, 2), std::invalid_argument);
  EXPECT_THROW(success_rate(-1, 2), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::study
