// Steps that are not worth their cost: an answer ends before them, but never because of what is no longer true.

#include "sliding/step_forecast.h"

#include <vector>

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

constexpr double kMargin = 2e-6;  // metres

Step step_of(double length, bool is_plain = true) {
  Step step;
  step.length = length;
  step.lengths[0] = length;
  step.is_plain = is_plain;
  return step;
}

/// A call with steps of these lengths, and whether the next one would be worthless.
bool next_is_worthless(StepForecast& forecast, const std::vector<double>& lengths) {
  forecast.begin_call(kMargin);
  for (const double length : lengths)
    forecast.note(step_of(length));
  return forecast.is_next_worthless();
}

TEST(StepForecast, KnowsNothingOfAFirstStepAtTheBeginning) {
  StepForecast forecast;
  EXPECT_FALSE(next_is_worthless(forecast, {90e-6}));
}

TEST(StepForecast, TakesAStepToBeFollowedAsInAnEarlierCall) {
  StepForecast forecast;
  next_is_worthless(forecast, {90e-6, 0.5e-6});
  EXPECT_TRUE(next_is_worthless(forecast, {95e-6}));
  next_is_worthless(forecast, {90e-6, 5e-6});
  EXPECT_FALSE(next_is_worthless(forecast, {95e-6}));
}

TEST(StepForecast, LooksAgainAfterEightCalls) {
  StepForecast forecast;
  next_is_worthless(forecast, {90e-6, 0.0});
  for (int call = 0; call < 8; ++call)
    EXPECT_TRUE(next_is_worthless(forecast, {90e-6}));
  EXPECT_FALSE(next_is_worthless(forecast, {90e-6}));
}

TEST(StepForecast, IsSilentAboutStepsOfOtherLengths) {
  StepForecast forecast;
  next_is_worthless(forecast, {90e-6, 0.0});
  EXPECT_FALSE(next_is_worthless(forecast, {30e-6}));
  EXPECT_FALSE(next_is_worthless(forecast, {200e-6}));
}

TEST(StepForecast, LeavesLessToTheNextCallWhereTheMotionIsLess) {
  StepForecast forecast;
  next_is_worthless(forecast, {100e-6, 0.4e-6});
  EXPECT_TRUE(next_is_worthless(forecast, {100e-6}));
  next_is_worthless(forecast, {2e-6, 0.4e-6});
  EXPECT_FALSE(next_is_worthless(forecast, {2e-6})) << "a fifth of what it moved";
}

TEST(StepForecast, LeavesNoMoreThanHalfAMarginToTheNextCall) {
  StepForecast forecast;
  next_is_worthless(forecast, {1e-3, 1.2e-6});
  EXPECT_FALSE(next_is_worthless(forecast, {1e-3}));
}

TEST(StepForecast, TakesShortStepsToShrinkOn) {
  StepForecast forecast;
  EXPECT_TRUE(next_is_worthless(forecast, {2.0e-6, 0.2e-6})) << "0.02 µm would follow";
  EXPECT_FALSE(next_is_worthless(forecast, {0.9e-6, 0.6e-6})) << "0.4 µm would follow";
}

TEST(StepForecast, IsSilentAfterAStepThatWasShortened) {
  StepForecast forecast;
  next_is_worthless(forecast, {90e-6, 0.0});
  forecast.begin_call(kMargin);
  forecast.note(step_of(90e-6, false));
  EXPECT_FALSE(forecast.is_next_worthless());
}

}  // namespace
}  // namespace glissade::haptics
