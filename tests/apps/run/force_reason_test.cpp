#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/run/force_reason.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>

namespace glissade::apps {
namespace {

using Cause = ForceReason::Cause;
using std::chrono::milliseconds;

/// A hand that holds the first part, without any reason.
devices::HapticState holding() {
  devices::HapticState state;
  state.hands[0].part = 0;
  return state;
}

TEST(ForceReason, IsNoneWhileNothingIsWrong) {
  EXPECT_EQ(force_reason(holding(), 0).cause, Cause::kNone);
  EXPECT_EQ(force_reason(holding(), 0).kind(), 0U);
  EXPECT_EQ(to_text(force_reason(holding(), 0)), "");
}

/// Each reason in turn is added to those before: the newest is the most serious.
TEST(ForceReason, IsTheMostSerious) {
  devices::HapticState state = holding();
  devices::HapticHandState& hand = state.hands[0];
  hand.glove_reasons.energy_limited = true;
  EXPECT_EQ(to_text(force_reason(state, 0)),
            "at the glove: reduced force: it has given back all energy that the hand put in");
  hand.reasons.force_limited = true;
  EXPECT_EQ(to_text(force_reason(state, 0)), "reduced force: it is at the device's limit");
  EXPECT_FALSE(force_reason(state, 0).is_fading());
  hand.contact_share = 0.4;
  EXPECT_EQ(force_reason(state, 0).cause, Cause::kLagging);
  hand.are_contacts_unsolved = true;
  EXPECT_EQ(force_reason(state, 0).cause, Cause::kUnsolved);
  hand.glove_reasons.is_command_old = true;
  hand.command_age = milliseconds(30);
  EXPECT_EQ(to_text(force_reason(state, 0)), "at the glove: no force: the command answers a state that is 30 ms old");
  state.contact_set_age = milliseconds(25);
  EXPECT_EQ(to_text(force_reason(state, 0)), "reduced force: the simulation's contacts are 25 ms old");
  hand.reasons.is_state_old = true;
  hand.state_age = milliseconds(12);
  EXPECT_EQ(to_text(force_reason(state, 0)), "no force: the glove's state is 12 ms old");
  EXPECT_TRUE(force_reason(state, 0).is_fading());
}

TEST(ForceReason, EndedGloveIsNotAnEmergencyStop) {
  devices::HapticState state = holding();
  state.hands[0].glove_reasons.is_stopped = true;
  EXPECT_EQ(to_text(force_reason(state, 0)), "no force: the glove has ended or was stopped for good");
}

TEST(ForceReason, SoftReturnAndRateLimitAreNotReported) {
  devices::HapticState state = holding();
  state.hands[0].reasons.is_returning = true;
  state.hands[0].reasons.rate_limited = true;
  state.hands[0].glove_reasons = state.hands[0].reasons;
  EXPECT_EQ(force_reason(state, 0).cause, Cause::kNone);
}

TEST(ForceReason, RecordedReasonIncludesSoftReturnAndRateLimit) {
  devices::HapticState state = holding();
  EXPECT_EQ(to_text(recorded_reason(state, 0)), "");
  state.hands[0].glove_reasons.rate_limited = true;
  EXPECT_EQ(to_text(recorded_reason(state, 0)),
            "at the glove: reduced force: it changes as fast as the device's limit allows");
  state.hands[0].reasons.is_returning = true;
  EXPECT_EQ(to_text(recorded_reason(state, 0)), "reduced force: it returns softly");
  state.hands[0].reasons.is_state_old = true;
  EXPECT_THAT(to_text(recorded_reason(state, 0)), testing::StartsWith("no force: the glove's state is "));
}

// A CSV file holds the texts as they are.
TEST(ForceReason, HasNoCommaInItsText) {
  for (std::size_t cause = 0; cause <= static_cast<std::size_t>(Cause::kLimitAtGlove); ++cause) {
    for (const devices::NamedReason& reason : devices::kLimitReasons) {
      ForceReason told{.cause = static_cast<Cause>(cause)};
      told.reasons.*reason.flag = true;
      EXPECT_EQ(to_text(told).find_first_of(",\"\n"), std::string::npos) << to_text(told);
    }
  }
}

TEST(ForceReason, KindIsIndependentOfTheAge) {
  devices::HapticState state = holding();
  state.hands[0].reasons.is_state_old = true;
  state.hands[0].state_age = milliseconds(12);
  const ForceReason young = force_reason(state, 0);
  state.hands[0].state_age = milliseconds(13);
  EXPECT_EQ(force_reason(state, 0).kind(), young.kind());
  state.hands[0].reasons.is_refused = true;
  EXPECT_NE(force_reason(state, 0).kind(), young.kind());
  EXPECT_LT(force_reason(state, 0).kind(), ForceReason::kKinds);
}

TEST(ForceReason, AHandWithoutAPartDoesNotLag) {
  devices::HapticState state;
  state.hands[0].contact_share = 0.0;
  EXPECT_EQ(force_reason(state, 0).cause, Cause::kNone);
}

TEST(ForceReason, NothingIsToldAtTheStartOfARun) {
  using contact::SlidingPart;
  const auto box = std::make_shared<const SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 12)));
  const auto plate = std::make_shared<const contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  const Eigen::Isometry3d X_WV(Eigen::Translation3d(0.0, 0.0, 0.03));
  grasping::GraspSimulation simulation({{plate}}, {{.part_V = box, .X_WV_start = X_WV}});
  devices::SimulatedGlove holds(geometry::PoseTrajectory({{milliseconds(0), X_WV}}));
  devices::SimulatedGlove is_empty(geometry::PoseTrajectory({{milliseconds(0), X_WV}}));
  haptics::run_offline(
      {{&holds, 0}, {&is_empty, std::nullopt}}, simulation, 100, [](const devices::HapticState& state) {
        for (const std::size_t hand : {0U, 1U})
          EXPECT_EQ(to_text(force_reason(state, hand)), "") << "hand " << hand << ", tick " << state.sequence;
      });
}

}  // namespace
}  // namespace glissade::apps
