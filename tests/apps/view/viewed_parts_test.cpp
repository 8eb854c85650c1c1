// The states of a server tell its scene from others.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/view/viewed_parts.h>

namespace glissade::apps {
namespace {

using testing::HasSubstr;

/// A movable peg, whose origin is at one end, and a movable ball about its origin.
ViewedParts peg_and_ball() {
  return ViewedParts(
      parse_scene("objects:\n"
                  "- {name: wall, shape: {type: box}}\n"
                  "- {name: peg, movable: true, shape: {type: box}, compliance_point_m: [0, 0, 0.05]}\n"
                  "- {name: ball, movable: true, shape: {type: sphere}}\n",
                  "scene.yaml", "."));
}

/// The state of a server with these parts.
devices::HapticState state_of_peg_and_ball() {
  devices::HapticState state;
  state.part_count = 2;
  state.parts[0].p_Vref = {0.0, 0.0, 0.05};
  state.parts[0].state = state.parts[1].state = devices::PartState::kFree;
  return state;
}

TEST(ViewedParts, MatchTheServerWithTheSameParts) {
  EXPECT_EQ(peg_and_ball().doubt(state_of_peg_and_ball()), "");
}

TEST(ViewedParts, DifferFromAServerWithAnotherPartCount) {
  devices::HapticState state = state_of_peg_and_ball();
  state.part_count = 1;
  EXPECT_EQ(peg_and_ball().doubt(state), "the server moves 1 parts, scene.yaml has 2: is it the server's scene?");
}

TEST(ViewedParts, DifferFromAServerWithAnotherReferencePoint) {
  devices::HapticState state = state_of_peg_and_ball();
  state.parts[1].p_Vref.x() = 0.001;
  EXPECT_THAT(peg_and_ball().doubt(state), HasSubstr("another one than 'ball' of scene.yaml"));
}

TEST(ViewedParts, AreNotDoubtedBeforeTheFirstAnswer) {
  devices::HapticState state = state_of_peg_and_ball();
  state.parts[0] = {};
  EXPECT_EQ(peg_and_ball().doubt(state), "");
}

TEST(ViewedParts, AreNotDoubtedIfAHandChoosesTheReferencePoint) {
  devices::HapticState state = state_of_peg_and_ball();
  state.parts[0].p_Vref.x() = 0.03;
  state.hand_count = 1;
  state.hands[0].visible.activity = hands::HandActivity::kHolding;
  EXPECT_EQ(peg_and_ball().doubt(state), "");
}

}  // namespace
}  // namespace glissade::apps
