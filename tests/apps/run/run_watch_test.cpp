#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/run/run_status.h>
#include <glissade/apps/run/run_watch.h>
#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A run with two gloves, whose clock begins at an hour.
class Watch : public testing::Test {
 protected:
  Watch() {
    state_.time = std::chrono::hours(1) - milliseconds(1);
    state_.hand_count = 2;
    state_.hands[0].part = 0;
  }

  /// So many ticks; every tenth of a second, it tells.
  void run(milliseconds duration) {
    for (milliseconds passed(0); passed < duration; ++passed) {
      state_.time += milliseconds(1);
      watch_.note(state_);
      if (++state_.sequence % 100 != 0) continue;
      const RunWatch::News news = watch_.news(7);
      told_.insert(told_.end(), news.events.begin(), news.events.end());
      status_ = news.status;
    }
  }

  RunWatch watch_{{"motor", "bracket"}, {{1, 0}, {2, std::nullopt}}, 12.0};
  devices::HapticState state_;
  std::vector<std::string> told_;
  std::string status_;
};

TEST_F(Watch, TellsNothingBeforeTheFirstTick) {
  const RunWatch::News news = watch_.news(0);
  EXPECT_THAT(news.events, IsEmpty());
  EXPECT_EQ(news.status, "");
}

TEST_F(Watch, TellsWhoTakesWhatAndLetsGo) {
  run(milliseconds(1000));
  EXPECT_THAT(told_, IsEmpty()) << "the part that the hand was given";
  state_.hands[1].part = 1;
  run(milliseconds(1000));
  state_.hands[0].part = -1;
  run(milliseconds(1000));
  state_.hands[0].part = 1;
  run(milliseconds(1000));
  EXPECT_THAT(told_, ElementsAre("1.000 s: glove 2 takes 'bracket'", "2.000 s: glove 1 lets go of 'motor'",
                                 "3.000 s: glove 1 takes 'bracket'"));
}

TEST_F(Watch, AbsentHandReportsNoRelease) {
  state_.hands[0].part = -1;
  run(milliseconds(1000));
  state_.hands[0].part = 0;
  run(milliseconds(1000));
  EXPECT_THAT(told_, IsEmpty());
  state_.hands[0].part = -1;
  run(milliseconds(1000));
  EXPECT_THAT(told_, ElementsAre("2.000 s: glove 1 lets go of 'motor'"));
}

TEST_F(Watch, RapidGraspsAreReportedAtALimitedRate) {
  for (int i = 0; i < 1000; ++i) {
    state_.hands[0].part = i % 2 - 1;
    run(milliseconds(7));
  }
  EXPECT_LE(told_.size(), 14U) << "in seven seconds";
}

TEST_F(Watch, TellsThatAGloveIsLostAndBack) {
  run(milliseconds(100));
  devices::HapticHandState& hand = state_.hands[1];
  hand.reasons.is_state_old = true;
  for (; hand.state_age < milliseconds(2000); hand.state_age += milliseconds(1))
    run(milliseconds(1));
  hand.reasons.is_state_old = false;
  hand.state_age = milliseconds(1);
  run(milliseconds(1000));
  EXPECT_THAT(told_, ElementsAre(HasSubstr("0.100 s: glove 2: no force: the glove's state is"),
                                 "0.699 s: glove 2 is lost: its newest state was measured 0.5 s ago",
                                 "2.199 s: glove 2 is back after 2.0 s",
                                 "2.699 s: glove 2: the force returns after 2.00 s (at 2.100 s)"));
}

TEST_F(Watch, TimesOfLinesNeverFall) {
  const auto is_old = [&](bool is) { state_.hands[1].reasons.is_state_old = is; };
  is_old(true);
  run(milliseconds(100));
  is_old(false);
  run(milliseconds(100));
  state_.hands[0].part = -1;
  run(milliseconds(900));
  EXPECT_THAT(told_, ElementsAre(HasSubstr("0.000 s: glove 2: no force: "), "0.200 s: glove 1 lets go of 'motor'",
                                 "0.699 s: glove 2: the force returns after 0.10 s (at 0.100 s)"));
}

TEST_F(Watch, ALateSimulationIsToldOnceForAllHands) {
  state_.contact_set_age = milliseconds(50);
  run(milliseconds(100));
  EXPECT_THAT(told_, ElementsAre("0.000 s: reduced force: the simulation's contacts are 50 ms old"));
}

TEST_F(Watch, ShowsTheRunInALine) {
  state_.parts[0].state = devices::PartState::kSliding;
  state_.hands[0].force_W = {0.0, 3.0, 4.0};
  state_.contact_set_age = std::chrono::microseconds(1234);
  run(milliseconds(1301));
  EXPECT_EQ(status_,
            "1.3/12.0 s  1000 Hz, 7 late, contacts 1.2 ms old  glove 1: 5.0 N, motor sliding  glove 2: holds nothing");
}

TEST_F(Watch, RateIsMeasuredOverTheLastTicks) {
  run(milliseconds(1000));
  state_.time += milliseconds(100);
  run(milliseconds(100));
  EXPECT_THAT(status_, HasSubstr(" 500 Hz"));
  EXPECT_THAT(watch_.news(7).status, HasSubstr(" 0 Hz")) << "a loop that halts";
}

/// A demonstration with the events that the README shows.
TEST(RunWatch, PrintsWhatTheReadmeShows) {
  RunWatch watch({"window_motor"}, {{1, 0}}, 10.0);
  devices::HapticState state;
  devices::HapticHandState& hand = state.hands[0];
  state.hand_count = 1;
  hand.part = 0;
  hand.force_W = {0.0, 0.0, 1.2};
  state.parts[0].state = devices::PartState::kSliding;
  state.contact_set_age = milliseconds(1);
  std::string lines;
  std::string status;
  for (milliseconds time(0); time <= milliseconds(5900); time += milliseconds(1)) {
    state.time = std::chrono::hours(1) + time;
    state.sequence = time.count() + 1;
    hand.reasons.is_state_old = time >= milliseconds(5298) && time < milliseconds(5304);
    hand.state_age = milliseconds(3);
    hand.glove_reasons.is_command_old = time >= milliseconds(5304) && time < milliseconds(5337);
    hand.command_age = milliseconds(8);
    watch.note(state);
    if (time.count() % 100 != 0) continue;
    const RunWatch::News news = watch.news(0);
    for (const std::string& event : news.events)
      lines += "glissade demo: " + event + '\n';
    status = news.status;
  }
  const std::string readme = read_text_file(std::string(GLISSADE_DOCS) + "/../README.md");
  EXPECT_THAT(readme, HasSubstr("```\n" + lines + status + "\n```")) << lines << status;
}

TEST(RunStatus, SaysWhyThereIsNoForce) {
  RunStatus status{.passed_s = 3.0, .gloves = {5}};
  devices::HapticHandState& hand = status.state.hands[0];
  hand.part = 0;
  hand.reasons.is_state_old = true;
  hand.state_age = milliseconds(14);
  EXPECT_EQ(to_text(status, {"motor"}),
            "3.0 s  0 late, contacts 0.0 ms old  glove 5: motor, no force: the glove's state is 14 ms old");
  hand.force_W.x() = 1.0;
  EXPECT_THAT(to_text(status, {"motor"}), HasSubstr("glove 5: 1.0 N, motor, no force: the glove's state"))
      << "it still fades";
}

}  // namespace
}  // namespace glissade::apps
