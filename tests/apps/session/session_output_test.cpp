#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/run/session.h>

#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A run of a hand with a part, of so many ticks.
Session session_of(std::int64_t ticks) {
  const auto samples = std::make_shared<SessionRecorder>(100, 1, 1);
  for (std::int64_t i = 0; i < ticks; ++i)
    samples->record({.sequence = i + 1});
  return {.ticks = ticks,
          .period = std::chrono::milliseconds(1),
          .objects = 2,
          .devices = {1},
          .samples = samples,
          .real_time = RealTimeFigures{}};
}

SessionSummary summary_of(const Session& session) {
  return {.ticks = session.ticks, .samples = session.ticks, .parts = {{.name = "motor"}}, .hands = {{.device = 1}}};
}

TEST(SessionRecorder, KeepsTheNewestTicksAndTheContactsOfEverySixteenth) {
  SessionRecorder recorder(100, 1, 1);
  for (int i = 0; i < 250; ++i) {
    devices::HapticState state;
    state.sequence = i + 1;
    state.time = std::chrono::milliseconds(i);
    state.contact_count = i / 16;  // of ticks 0, 16, 32, …
    recorder.record(state);
  }
  ASSERT_EQ(recorder.size(), 100u);
  for (std::size_t i = 0; i < recorder.size(); ++i) {
    const devices::HapticState state = recorder.state(i);
    const auto tick = static_cast<int>(150 + i);
    EXPECT_EQ(state.sequence, tick + 1);
    EXPECT_EQ(state.time, std::chrono::milliseconds(tick));
    EXPECT_EQ(state.contact_count, tick / 16) << tick;
  }
}

TEST(SessionText, OfARunThatNeverBeganSaysSo) {
  const Session session = session_of(0);
  EXPECT_EQ(to_text(summary_of(session), session, true),
            "  ticks                        0: the run ended before the first state of a glove\n");
}

TEST(SessionText, LeavesTheStagesOfTheSearchToWhoeverAsks) {
  Session session = session_of(10);
  session.collision_frames = 4;
  const SessionSummary summary = summary_of(session);
  const std::string brief = to_text(summary, session, false);
  EXPECT_THAT(brief, HasSubstr("part motor"));
  EXPECT_THAT(brief, HasSubstr("greatest force 0.00 N"));
  for (const char* internal : {"collision frames", "DOP-trees", "hash"}) {
    EXPECT_THAT(brief, Not(HasSubstr(internal)));
    EXPECT_THAT(to_text(summary, session, true), HasSubstr(internal));
  }
}

TEST(SessionText, WarnsIfMostCallsEndedEarlyInRealTime) {
  Session session = session_of(10);
  session.calls.calls = 10;
  session.calls.ended_early = 5;
  EXPECT_EQ(real_time_warning(session), "");
  session.calls.ended_early = 6;
  EXPECT_THAT(real_time_warning(session), HasSubstr("did not keep up with real time: 6 of its 10 calls ended early"));
  session.real_time.reset();
  EXPECT_EQ(real_time_warning(session), "") << "an offline run has all the time that it needs";
}

TEST(SessionText, WarnsIfAnswersWereOldInRealTime) {
  Session session = session_of(10);
  session.real_time->server.contact_set_age.record(std::chrono::milliseconds(49));
  EXPECT_EQ(real_time_warning(session), "");
  session.real_time->server.contact_set_age.record(std::chrono::milliseconds(104));
  EXPECT_THAT(real_time_warning(session), HasSubstr("one contact set in a hundred was more than 10"));
}

TEST(SessionText, BeginsWithWhetherTheGoalWasReached) {
  const Session session = session_of(10);
  SessionSummary summary = summary_of(session);
  summary.goal_reached = true;
  summary.goal_distance_m = 1e-4;
  EXPECT_THAT(to_text(summary, session, false), StartsWith("  goal reached                 yes, 0.100 mm from it\n"));
}

TEST(SessionText, ARunWithoutASearchHasNoMeans) {
  const Session session = session_of(10);
  EXPECT_THAT(to_text(summary_of(session), session, true), Not(HasSubstr("nan")));
  const nlohmann::json json = to_json(summary_of(session), session);
  EXPECT_TRUE(json["collision_stages"]["exact"]["us"].is_null());
  EXPECT_EQ(json["collision_frames"], 0);
  EXPECT_EQ(json["calls_ended_early"], 0);
}

TEST(SessionReport, NamesSceneMetaphorAndRules) {
  test_support::TemporaryFolder folder;
  Session session = session_of(0);
  session.choice = {.metaphor = "incremental", .friction = {0.2, 0.3}, .spiral_search = true};
  HapticScene scene;
  scene.source = "bench.yaml";
  const std::string page = write_session_report(summary_of(session), session, "run", folder.path("report"), scene);
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  for (const char* cell : {"bench.yaml", "incremental", "friction 0.2, at rest 0.3; spiral search"})
    EXPECT_THAT(text.str(), HasSubstr("<td>" + std::string(cell) + "</td>"));
}

TEST(SessionReport, SaysIfItShowsTheEndOfTheRunOnly) {
  test_support::TemporaryFolder folder;
  const Session session = session_of(300);
  SessionSummary summary = summary_of(session);
  summary.samples = 0;  // nothing to plot
  const std::string page = write_session_report(summary, session, "run", folder.path("report"), HapticScene{});
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("<td>the last 0.1 s of 0.3 s</td>"));
}

TEST(SessionReport, OfARunThatNeverBeganIsAPage) {
  test_support::TemporaryFolder folder;
  const Session session = session_of(0);
  const std::string page =
      write_session_report(summary_of(session), session, "run", folder.path("report"), HapticScene{});
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("before the first state"));
  EXPECT_THAT(text.str(), Not(HasSubstr("nan")));
  EXPECT_THAT(text.str(), Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace glissade::apps
