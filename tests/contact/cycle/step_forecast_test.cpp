// Steps that are not worth their cost: an answer ends before them, but never because of what is no longer true.

#include "cycle/step_forecast.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::contact {
namespace {

constexpr double kMargin = 2e-6;  // metres

Step step_of(double length, bool is_plain = true) {
  Step step;
  step.length = length;
  step.lengths[0] = length;
  step.is_plain = is_plain;
  step.displacements[0].v.x() = length;
  return step;
}

class StepForecasts : public ::testing::Test {
 protected:
  /// A call with steps of these lengths, and whether the rest would be worthless.
  bool remainder_is_worthless(const std::vector<double>& lengths) {
    std::vector<Step> steps;
    for (const double length : lengths)
      steps.push_back(step_of(length));
    return remainder_is_worthless_after(steps);
  }
  bool remainder_is_worthless_after(const std::vector<Step>& steps) {
    forecast_.begin_call(parts_, kMargin, kMargin);
    for (const Step& step : steps)
      forecast_.note(step);
    return forecast_.is_remainder_worthless();
  }

  static constexpr double kLever = 0.01;  // metres
  std::vector<PartToForecast> parts_{{Metaphor::kForceFeedback, kLever}};
  StepForecast forecast_;
};

TEST_F(StepForecasts, NoForecastForAFirstStepWithoutAnEarlierCall) {
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, RemainderIsPredictedFromTheEarlierCall) {
  remainder_is_worthless({90e-6, 0.5e-6, 0.01e-6});
  EXPECT_TRUE(remainder_is_worthless({95e-6}));
  remainder_is_worthless({90e-6, 5e-6, 0.01e-6});
  EXPECT_FALSE(remainder_is_worthless({95e-6}));
}

TEST_F(StepForecasts, CallsThatDidNotConvergeAreIgnored) {
  EXPECT_FALSE(remainder_is_worthless({90e-6, 0.9e-6, 0.8e-6})) << "the limit of cycles may end it";
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, ForecastExpiresAfterFourCalls) {
  remainder_is_worthless({90e-6, 0.0});
  for (int call = 0; call < 4; ++call)
    EXPECT_TRUE(remainder_is_worthless({90e-6}));
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, NoForecastForStepsOfOtherLengths) {
  remainder_is_worthless({90e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({30e-6}));
  EXPECT_FALSE(remainder_is_worthless({200e-6}));
}

TEST_F(StepForecasts, RemainderIsQuadraticInTheStepLength) {
  remainder_is_worthless({60e-6, 0.4e-6, 0.0});
  EXPECT_TRUE(remainder_is_worthless({60e-6}));
  EXPECT_FALSE(remainder_is_worthless({110e-6})) << "1.3 µm";
}

TEST_F(StepForecasts, AllowedRemainderShrinksWithTheMotion) {
  remainder_is_worthless({100e-6, 0.4e-6, 0.0});
  EXPECT_TRUE(remainder_is_worthless({100e-6}));
  remainder_is_worthless({2e-6, 0.4e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({2e-6})) << "a fifth of what it moved";
}

TEST_F(StepForecasts, ShortStepsArePredictedToShrinkGeometrically) {
  EXPECT_TRUE(remainder_is_worthless({2.0e-6, 0.2e-6})) << "0.02 µm would follow";
  EXPECT_FALSE(remainder_is_worthless({0.9e-6, 0.6e-6})) << "1.2 µm would follow";
}

TEST_F(StepForecasts, NoForecastAfterAShortenedStep) {
  remainder_is_worthless({90e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless_after({step_of(90e-6, false)}));
}

TEST_F(StepForecasts, CallsWithShortenedStepsAreIgnored) {
  remainder_is_worthless({90e-6, 0.0});
  remainder_is_worthless_after({step_of(90e-6), step_of(0.0, false)});
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, EachPartIsForecastSeparately) {
  parts_.push_back(parts_.front());
  const auto both = [](double first, double second) {
    Step step = step_of(first);
    step.lengths[1] = second;
    step.length += second;
    return step;
  };
  remainder_is_worthless_after({both(90e-6, 3e-6), both(0.0, 0.8e-6), both(0.0, 0.0)});
  EXPECT_FALSE(remainder_is_worthless_after({both(90e-6, 3e-6)})) << "a quarter of what the slow one moved";
}

TEST_F(StepForecasts, IncrementalMetaphorAllowsLessRemainder) {
  parts_.front().metaphor = Metaphor::kIncremental;
  remainder_is_worthless({90e-6, 0.5e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, ForgetDiscardsEarlierCalls) {
  remainder_is_worthless({90e-6, 0.0});
  forecast_.forget();
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

/// A step of a part by (x, y) and a turn about z, metres and rad.
Step step_by(double x, double y, double turn = 0.0) {
  Step step;
  step.displacements[0] = {{x, y, 0.0}, {0.0, 0.0, turn}};
  step.lengths[0] = step.length = std::hypot(x, y) + 0.01 * std::abs(turn);
  step.is_plain = true;
  return step;
}

// Contacts that bend may lead a part in a circle.
TEST_F(StepForecasts, ThreeStepsBackToTheirStartEndTheCall) {
  const Step first = step_by(80e-6, 0.0);
  const std::vector<Step> circle{first, step_by(4e-6, 0.0, 4e-4), step_by(-1e-6, 2e-6, -1e-4),
                                 step_by(-2.98e-6, -2.02e-6, -2.98e-4)};
  EXPECT_TRUE(remainder_is_worthless_after(circle));
  EXPECT_FALSE(remainder_is_worthless_after({circle[0], circle[1], circle[2]})) << "not yet";
  std::vector<Step> turning_on = circle;
  turning_on[3].displacements[0].w.z() = 1e-4;
  EXPECT_FALSE(remainder_is_worthless_after(turning_on));
  std::vector<Step> shortened = circle;
  shortened[2].is_plain = false;
  EXPECT_FALSE(remainder_is_worthless_after(shortened));
}

TEST_F(StepForecasts, ConvergingStepsDoNotEndTheCall) {
  EXPECT_FALSE(remainder_is_worthless_after({step_by(100e-6, 0.0), step_by(-80e-6, 0.0), step_by(64e-6, 0.0)}))
      << "to and fro";
  constexpr double kThird = 2.0943951;  // rad
  std::vector<Step> spiral;
  for (int i = 0; i < 6; ++i) {
    const double length = 100e-6 * std::pow(0.9, i);
    spiral.push_back(step_by(length * std::cos(i * kThird), length * std::sin(i * kThird)));
  }
  EXPECT_FALSE(remainder_is_worthless_after(spiral));
}

TEST_F(StepForecasts, CyclicStepsAreIgnored) {
  remainder_is_worthless_after({step_by(5e-6, 0.0), step_by(-2e-6, 0.0), step_by(-3e-6, 0.0)});
  EXPECT_FALSE(remainder_is_worthless({5e-6}));
}

TEST_F(StepForecasts, CallOfSeveralPartsEndsOnlyIfAllCycleOrStand) {
  parts_.push_back(parts_.front());
  std::vector<Step> steps{step_by(4e-6, 0.0), step_by(-1e-6, 2e-6), step_by(-3e-6, -2e-6)};
  EXPECT_TRUE(remainder_is_worthless_after(steps)) << "the other one stands still";
  for (Step& step : steps) {
    step.displacements[1].v.x() = 10e-6;
    step.lengths[1] = 10e-6;
  }
  EXPECT_FALSE(remainder_is_worthless_after(steps));
}

}  // namespace
}  // namespace glissade::contact
