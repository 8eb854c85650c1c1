#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/run/reason_teller.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ForceReason without_switch() {
  ForceReason reason{.cause = ForceReason::Cause::kEnvelope};
  reason.reasons.is_disabled = true;
  return reason;
}

ForceReason lagging() {
  return {.cause = ForceReason::Cause::kLagging};
}

ForceReason at_the_limit() {
  ForceReason reason{.cause = ForceReason::Cause::kLimit};
  reason.reasons.force_limited = true;
  return reason;
}

/// A loop of 1 kHz whose news are asked for ten times a second.
class Teller : public testing::Test {
 protected:
  void run(milliseconds duration, const ForceReason& reason) {
    for (const milliseconds end = now_ + duration; now_ < end;) {
      now_ += milliseconds(1);
      teller_.note(now_, reason);
      if (now_.count() % 100 == 0) ask();
    }
  }

  void ask() {
    for (const TimedSentence& sentence : teller_.news())
      told_.push_back(std::to_string(sentence.time / milliseconds(1)) + " " + sentence.text);
  }

  ReasonTeller teller_;
  milliseconds now_{0};
  std::vector<std::string> told_;
};

TEST_F(Teller, TellsWhenAReasonBeginsAndWhenTheForceIsBack) {
  run(milliseconds(1010), {});
  run(milliseconds(1000), without_switch());
  EXPECT_THAT(told_, ElementsAre("1011 no force: the wearer does not hold the enable switch"));
  run(milliseconds(400), {});
  EXPECT_THAT(told_, SizeIs(1)) << "it might fade again at once";
  run(milliseconds(1000), {});
  EXPECT_THAT(told_, ElementsAre(HasSubstr("no force"), "2011 the force returns after 1.00 s"));
}

TEST_F(Teller, TellsAReasonOfASingleTick) {
  run(milliseconds(50), {});
  run(milliseconds(1), without_switch());
  run(milliseconds(100), {});
  EXPECT_THAT(told_, ElementsAre(HasSubstr("51 no force")));
}

TEST_F(Teller, TellsEachReasonOfAnInterruption) {
  run(milliseconds(50), without_switch());
  run(milliseconds(100), lagging());
  run(milliseconds(1000), {});
  EXPECT_THAT(
      told_, ElementsAre(HasSubstr("1 no force"), HasSubstr("51 reduced force"), "151 the force returns after 0.15 s"));
}

TEST_F(Teller, IntermittentReasonsAreReportedAtMostEvery5Seconds) {
  for (int i = 0; i < 1000; ++i) {
    run(milliseconds(i % 60 + 1), without_switch());
    run(milliseconds(i % 7 + 1), i % 2 == 0 ? ForceReason{} : lagging());
  }
  EXPECT_GT(now_, std::chrono::seconds(30));
  EXPECT_LE(told_.size(), 2 * static_cast<std::size_t>(now_ / std::chrono::seconds(5) + 1));
  EXPECT_GE(told_.size(), 2U);
}

TEST_F(Teller, AnInterruptionTooSoonAfterTheLastIsToldIfItLasts) {
  run(milliseconds(10), without_switch());
  run(milliseconds(990), {});
  run(milliseconds(3000), without_switch());
  EXPECT_THAT(told_, ElementsAre(HasSubstr("1 no force"), "11 the force returns after 0.01 s"));
  run(milliseconds(2000), without_switch());
  EXPECT_THAT(told_,
              ElementsAre(HasSubstr("1 no force"), "11 the force returns after 0.01 s", HasSubstr("1001 no force")));
  run(milliseconds(10'000), without_switch());
  EXPECT_THAT(told_, SizeIs(3));
}

TEST_F(Teller, ALimitIsToldOnceWhenItLasts) {
  run(milliseconds(50), at_the_limit());
  run(milliseconds(150), {});
  EXPECT_THAT(told_, IsEmpty());
  run(milliseconds(20'000), at_the_limit());
  EXPECT_THAT(told_, ElementsAre("201 reduced force: it is at the device's limit"));
  run(milliseconds(2000), {});
  EXPECT_THAT(told_, SizeIs(1)) << "the force was never away";
}

TEST_F(Teller, TheForceIsBackAlsoAtALimit) {
  run(milliseconds(100), without_switch());
  run(milliseconds(700), at_the_limit());
  EXPECT_THAT(told_, ElementsAre(HasSubstr("1 no force"), "101 the force returns after 0.10 s",
                                 HasSubstr("101 reduced force")));
}

TEST_F(Teller, TellsInTheOrderOfTime) {
  run(milliseconds(100), {});
  run(milliseconds(3), without_switch());
  run(milliseconds(97), {});
  run(milliseconds(1000), at_the_limit());
  EXPECT_THAT(told_, ElementsAre(HasSubstr("101 no force"), "104 the force returns after 0.003 s",
                                 HasSubstr("201 reduced force")));
}

TEST_F(Teller, ReturnIsReportedAfterTheQueueOverflowed) {
  for (int i = 0; i < 3000; ++i) {
    now_ += milliseconds(1);
    teller_.note(now_, i % 2 == 0 ? without_switch() : lagging());
  }
  ask();
  EXPECT_THAT(told_, SizeIs(2));
  run(milliseconds(1000), {});
  EXPECT_EQ(told_.back(), "3001 the force returns after 3.00 s");
}

}  // namespace
}  // namespace glissade::apps
