#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/run/missed_goal.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/run/session_check.h>
#include <glissade/geometry/mesh_generators.h>

#include "report_page.h"
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
  return {.ticks = session.ticks,
          .samples = session.ticks,
          .checked = session.ticks,
          .parts = {{.name = "motor"}},
          .hands = {{.device = 1}}};
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

TEST(SessionText, SearchStagesAreShownOnlyOnRequest) {
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

TEST(SessionText, SaysWhyAHandWithFingersHeldNothing) {
  const Session session = session_of(10);
  SessionSummary summary = summary_of(session);
  EXPECT_THAT(to_text(summary, session, false), Not(HasSubstr("held nothing")));
  EXPECT_TRUE(to_json(summary, session)["hands"][0]["missed_grasp"].is_null());
  summary.hands[0].missed_grasp = "it touched nothing";
  EXPECT_THAT(to_text(summary, session, false), HasSubstr("why it held nothing        it touched nothing\n"));
  EXPECT_EQ(to_json(summary, session)["hands"][0]["missed_grasp"], "it touched nothing");
}

TEST(SessionText, SaysForHowLongAHandFeltLessThanItsContacts) {
  const Session session = session_of(10);
  SessionSummary summary = summary_of(session);
  summary.hands[0].lagging_ticks = 2624;
  EXPECT_THAT(to_text(summary, session, false),
              HasSubstr("time with reduced force    contacts below half of their force 2.624 s\n"));
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
  EXPECT_THAT(real_time_warning(session),
              HasSubstr("the machine did not keep up with real time: one contact set in a hundred was more than 10"));
  session.calls.unsettled_friction = 7;
  EXPECT_THAT(real_time_warning(session), HasSubstr("the simulation did not keep up")) << "the scene is the reason";
  EXPECT_THAT(real_time_warning(session), HasSubstr("friction did not settle in 7 steps"));
}

TEST(SessionText, BeginsWithWhetherTheGoalWasReached) {
  const Session session = session_of(10);
  SessionSummary summary = summary_of(session);
  summary.goal_reached = true;
  summary.goal_distance_m = 1e-4;
  EXPECT_THAT(to_text(summary, session, false), StartsWith("  goal reached                 yes, 0.100 mm from it\n"));
}

/// What the hand does in each of 100 ticks, and the part that it holds.
Session session_of_hand(const std::function<std::pair<hands::HandActivity, int>(int tick)>& at) {
  Session session = session_of(0);
  const auto samples = std::make_shared<SessionRecorder>(100, 1, 1);
  for (int i = 0; i < 100; ++i) {
    devices::HapticState state{.sequence = i + 1, .time = std::chrono::milliseconds(i)};
    std::tie(state.hands[0].visible.activity, state.hands[0].part) = at(i);
    state.contact_set_age = std::chrono::milliseconds(i < 60 ? 20 : 21);
    state.parts[0].X_WV.translation().x() = 1e-3 * i;
    samples->record(state);
  }
  session.samples = samples;
  return session;
}

TEST(MissedGoal, IsExplainedByWhatTheHandDid) {
  using hands::HandActivity;
  HapticScene scene;
  scene.X_WGoal = Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0));
  const auto why = [&](const Session& session) {
    SessionSummary summary = summary_of(session);
    summary.goal_distance_m = 0.9;
    return why_goal_is_missed(summary, session, scene);
  };
  // It waits before it is anywhere, which is no reason.
  EXPECT_EQ(
      why(session_of_hand([](int i) {
        return std::pair(i < 10 ? HandActivity::kWaiting : i < 80 ? HandActivity::kFree : HandActivity::kLost, -1);
      })),
      "'motor' missed its goal by 900.0 mm: no hand ever held it; the hand was lost for "
      "0.02 s "
      "because its states came late; contacts were older than 20 ms for 0.04 s");
  const std::string let_go = why(session_of_hand(
      [](int i) { return std::pair(i > 50 ? HandActivity::kFree : HandActivity::kHolding, i > 50 ? -1 : 0); }));
  EXPECT_THAT(let_go, HasSubstr("it was let go at 0.05 s, 950.0 mm from the goal"));
  const std::string held = why(session_of_hand([](int) { return std::pair(HandActivity::kHolding, 0); }));
  EXPECT_THAT(held, HasSubstr("at the end it was unknown, 99.0 mm from where the hand wanted it"));
}

TEST(SessionCheck, EarlyEndHasCheckedTicksOfTheWholeRun) {
  const auto box = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.01, 0.01, 0.01}, 12));
  HapticScene scene;
  scene.placed_obstacles = {{box, Eigen::Isometry3d(Eigen::Translation3d(0.09, 0.0, 0.0))}};
  scene.parts = {{.name = "box", .part_V = std::make_shared<const contact::SlidingPart>(box)}};
  const Session session = session_of_hand([](int) { return std::pair(hands::HandActivity::kNone, -1); });
  const SessionCheck whole(*session.samples, scene, {nullptr});
  EXPECT_EQ(whole.checked_ticks(), 100);
  EXPECT_EQ(whole.colliding_ticks_of_part(0), 20) << "from 80 mm on";
  const SessionCheck hasty(*session.samples, scene, {nullptr}, [] { return true; });
  EXPECT_EQ(hasty.checked_ticks(), 2) << "ticks 0 and 64";
  EXPECT_EQ(hasty.colliding_ticks_of_part(0), 0);
}

TEST(SessionCheck, AnOpenPartMayLieOnABodyButNotCutIt) {
  const auto table = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.02}, 12));
  const auto sheet = std::make_shared<const geometry::TriangleMesh>(geometry::make_plate({0.03, 0.03}, 2));
  const Eigen::Isometry3d X_WTable(Eigen::Translation3d(0.0, 0.0, -0.01));
  HapticScene scene;
  scene.placed_obstacles = {{table, X_WTable}};
  scene.obstacles = {{.body = std::make_shared<const contact::ContactBody>(table), .X_WO = X_WTable}};
  scene.parts = {{.name = "sheet", .part_V = std::make_shared<const contact::SlidingPart>(sheet)}};
  SessionRecorder samples(100, 1, 1);
  for (int i = 0; i < 100; ++i) {
    devices::HapticState state;
    state.parts[0].X_WV.translation().x() = 1e-4 * i;
    if (i >= 90) state.parts[0].X_WV.linear() = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()).toRotationMatrix();
    samples.record(state);
  }
  EXPECT_EQ(SessionCheck(samples, scene, {nullptr}).colliding_ticks_of_part(0), 10) << "those that are tilted";
}

TEST(SessionText, MeansAreNullWithoutASearch) {
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

TEST(SessionReport, IsWrittenForARunWithoutTicks) {
  test_support::TemporaryFolder folder;
  const Session session = session_of(0);
  const std::string page =
      write_session_report(summary_of(session), session, "run", folder.path("report"), HapticScene{});
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  const std::string content = test_support::content_of(text.str());
  EXPECT_THAT(content, HasSubstr("before the first state"));
  EXPECT_THAT(content, Not(HasSubstr("nan")));
  EXPECT_THAT(content, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace glissade::apps
