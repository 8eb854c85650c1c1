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
  step.energy_after = length;  // joules: any that falls as steps shrink
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

  std::vector<Metaphor> parts_{Metaphor::kForceFeedback};
  StepForecast forecast_;
};

TEST_F(StepForecasts, KnowNothingOfAFirstStepAtTheBeginning) {
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, TakeAStepToBeFollowedAsInAnEarlierCall) {
  remainder_is_worthless({90e-6, 0.5e-6, 0.01e-6});
  EXPECT_TRUE(remainder_is_worthless({95e-6}));
  remainder_is_worthless({90e-6, 5e-6, 0.01e-6});
  EXPECT_FALSE(remainder_is_worthless({95e-6}));
}

TEST_F(StepForecasts, LearnNothingFromCallsThatEndedForOtherReasons) {
  EXPECT_FALSE(remainder_is_worthless({90e-6, 0.9e-6, 0.8e-6})) << "the limit of cycles may end it";
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, LookAgainAfterFourCalls) {
  remainder_is_worthless({90e-6, 0.0});
  for (int call = 0; call < 4; ++call)
    EXPECT_TRUE(remainder_is_worthless({90e-6}));
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, AreSilentAboutStepsOfOtherLengths) {
  remainder_is_worthless({90e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({30e-6}));
  EXPECT_FALSE(remainder_is_worthless({200e-6}));
}

TEST_F(StepForecasts, TakeWhatIsLeftToBeOfSecondOrder) {
  remainder_is_worthless({60e-6, 0.4e-6, 0.0});
  EXPECT_TRUE(remainder_is_worthless({60e-6}));
  EXPECT_FALSE(remainder_is_worthless({110e-6})) << "1.3 µm";
}

TEST_F(StepForecasts, LeaveLessToTheNextCallWhereTheMotionIsLess) {
  remainder_is_worthless({100e-6, 0.4e-6, 0.0});
  EXPECT_TRUE(remainder_is_worthless({100e-6}));
  remainder_is_worthless({2e-6, 0.4e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({2e-6})) << "a fifth of what it moved";
}

TEST_F(StepForecasts, TakeShortStepsToShrinkOn) {
  EXPECT_TRUE(remainder_is_worthless({2.0e-6, 0.2e-6})) << "0.02 µm would follow";
  EXPECT_FALSE(remainder_is_worthless({0.9e-6, 0.6e-6})) << "1.2 µm would follow";
}

TEST_F(StepForecasts, AreSilentAfterAStepThatWasShortened) {
  remainder_is_worthless({90e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless_after({step_of(90e-6, false)}));
}

TEST_F(StepForecasts, LearnNothingFromStepsThatWereShortened) {
  remainder_is_worthless({90e-6, 0.0});
  remainder_is_worthless_after({step_of(90e-6), step_of(0.0, false)});
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, OfOnePartDoNotHideAnother) {
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

TEST_F(StepForecasts, LeaveNoMoreThanAtRestWhereItWouldNotBeMadeUpFor) {
  parts_.front() = Metaphor::kIncremental;
  remainder_is_worthless({90e-6, 0.5e-6, 0.0});
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

TEST_F(StepForecasts, ForgetWhatWasBeforeANewHold) {
  remainder_is_worthless({90e-6, 0.0});
  forecast_.forget();
  EXPECT_FALSE(remainder_is_worthless({90e-6}));
}

/// A call whose steps leave so much energy in the springs.
std::vector<Step> steps_with_energies(const std::vector<double>& energies) {
  std::vector<Step> steps;
  for (const double energy : energies) {
    steps.push_back(step_of(5e-6));
    steps.back().energy_after = energy;
  }
  return steps;
}

// Contacts that bend may lead a part in a circle.
TEST_F(StepForecasts, EndACallWhoseStepsGetNowhere) {
  EXPECT_FALSE(remainder_is_worthless_after(steps_with_energies({3e-3, 2e-3, 2.5e-3})));
  EXPECT_TRUE(remainder_is_worthless_after(steps_with_energies({3e-3, 2e-3, 2.5e-3, 2e-3})));
  EXPECT_FALSE(remainder_is_worthless_after(steps_with_energies({3e-3, 4e-3}))) << "a contact got its margin back";
}

TEST_F(StepForecasts, LearnNothingFromSuchACall) {
  remainder_is_worthless_after(steps_with_energies({3e-3, 3e-3, 3e-3}));
  EXPECT_FALSE(remainder_is_worthless({5e-6}));
}

TEST_F(StepForecasts, LetStepsGoOnThatWereShortenedOrAimElsewhere) {
  std::vector<Step> steps = steps_with_energies({2e-3, 2e-3, 2e-3});
  steps.front().is_plain = false;
  EXPECT_FALSE(remainder_is_worthless_after(steps));
  steps.front().is_plain = true;
  EXPECT_TRUE(remainder_is_worthless_after(steps));
  parts_ = {Metaphor::kRubberBand};
  EXPECT_FALSE(remainder_is_worthless_after(steps));
}

}  // namespace
}  // namespace glissade::haptics
