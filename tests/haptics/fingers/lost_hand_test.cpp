/// What a hand does that is not free to clasp: it has started inside something, the cart has moved it there, or its
/// tracker has lost it. It says so, gives no torques, and comes back where it is free.

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/grasp_simulation.h>

#include "loop/finger_rows.h"
#include "poses.h"
#include "worn_glove.h"

namespace glissade::haptics {
namespace {

using grasping::ClaspState;
using grasping::GraspAnalysis;
using grasping::Posture;
using grasping::TouchingSegments;
using hands::JointValues;
using std::chrono::milliseconds;
using test_support::at;
using test_support::bent_hand;
using test_support::ClaspedHand;
using test_support::hand_chain;
using test_support::hand_model;
using test_support::open_hand;
using test_support::WornGlove;

constexpr double kBall_m = 0.035;

/// A hand at rest that closes after 100 ms.
WornGlove glove_at(const Eigen::Isometry3d& X_WBall,
                   std::vector<std::chrono::nanoseconds> grips = {milliseconds(100)}) {
  return {geometry::make_sphere(kBall_m, 2000), X_WBall,
          geometry::PoseTrajectory({{milliseconds(0), Eigen::Isometry3d::Identity()}}), bent_hand(0.9),
          std::move(grips)};
}

Eigen::Isometry3d before_the_palm() {
  return at(0.095, 0.0, -0.056);
}

TEST(LostHand, ThatStartsInsideGivesNoTorqueUntilItIsFree) {
  WornGlove glove = glove_at(at(0.095, 0.0, 0.0));
  for (int i = 0; i < 500; ++i) {
    glove.step();
    ASSERT_EQ(glove.hand.clasp.state(), ClaspState::kWaiting);
    ASSERT_EQ(glove.wanted(), JointValues{});
    ASSERT_TRUE(glove.hand.clasp.contacts().empty());
  }
  glove.hand.clasp.place_object(0, before_the_palm());
  glove.run(1);
  EXPECT_EQ(glove.hand.clasp.state(), ClaspState::kWaiting) << "the fist is still inside";
  glove.hand.clasp.place_object(0, at(1.0));
  glove.run(1);
  EXPECT_EQ(glove.hand.clasp.state(), ClaspState::kClasping);
}

TEST(LostHand, ThatTheCartMovesIntoSomethingGivesNoTorqueUntilItIsFree) {
  FingerForces forces(finger_hand(*hand_model()), devices::simulated_glove_descriptor());
  HandAnswer answer;
  FingerRows rows;
  ClaspedHand hand(geometry::make_sphere(kBall_m, 2000), before_the_palm());
  const auto torques_at = [&](const Posture& target) {
    hand.clasp.advance(target);
    JointValues angles{};
    std::copy(target.values.begin(), target.values.end(), angles.begin());
    rows.tell(hand.clasp, hand.clasp.contacts(), 0, answer);
    return forces.update(angles, answer);
  };
  torques_at(open_hand());
  for (int i = 0; i < 100; ++i)
    torques_at(bent_hand(0.009 * i));
  EXPECT_NE(torques_at(bent_hand(0.9)), JointValues{});
  Posture fist = bent_hand(0.9);
  fist.X_WR = at(0.0, 0.0, -0.05);
  hand.clasp.move_cart(fist);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(torques_at(fist), JointValues{});
    EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting);
  }
  fist.X_WR = at(0.0, 0.0, 0.3);
  torques_at(fist);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
}

// A gap of some milliseconds in the glove's states ends no grasp: the visible hand stays and goes on touching. Torques
// fade at once all the same, because nobody knows where the fingers are.
TEST(LostHand, OfAShortGapKeepsTheGraspButNotTheTorques) {
  WornGlove glove = glove_at(before_the_palm());
  GraspAnalysis analysis(*hand_model());
  glove.run(1000);
  const TouchingSegments segments = analysis.update(glove.hand.clasp.contacts(), 100.0).segments;
  ASSERT_GE(segments.count(), 4);
  const std::vector<double> values = glove.hand.clasp.posture().values;
  glove.lose_tracking(10);
  for (int i = 0; i < 10; ++i) {
    glove.step();
    EXPECT_EQ(glove.hand.clasp.state(), ClaspState::kClasping);
    EXPECT_EQ(glove.hand.clasp.posture().values, values);
    EXPECT_EQ(glove.wanted(), JointValues{});
    EXPECT_EQ(analysis.update(glove.hand.clasp.contacts(), 1.0).segments, segments);
  }
  EXPECT_EQ(glove.command().values().joint_torques, JointValues{}) << "the fade lasts seven periods";
  glove.run(500);
  EXPECT_NE(glove.command().values().joint_torques, JointValues{});
}

// The loss is told after 20 ms. The fingers, which nothing holds back meanwhile, sink into the ball: the hand goes on
// from where it was, round the ball.
TEST(LostHand, LongTrackingGapEndsContactsAndResumesFromLastPosture) {
  WornGlove glove = glove_at(before_the_palm());
  GraspAnalysis analysis(*hand_model());
  glove.run(1000);
  const Posture last = glove.hand.clasp.posture();
  glove.lose_tracking(300);
  glove.run(200);
  EXPECT_EQ(glove.hand.clasp.state(), ClaspState::kLost);
  EXPECT_EQ(name_of(glove.hand.clasp.state()), "lost");
  EXPECT_EQ(glove.hand.clasp.posture().values, last.values) << "the visible hand stays";
  EXPECT_TRUE(glove.hand.clasp.contacts().empty());
  glove.run(1000);
  EXPECT_EQ(glove.hand.clasp.state(), ClaspState::kClasping) << "the tracker is back";
  EXPECT_GE(analysis.update(glove.hand.clasp.contacts(), 100.0).segments.count(), 4);
  EXPECT_NE(glove.command().values().joint_torques, JointValues{});
}

TEST(LostHand, WaitsIfTargetAndLastPostureBothCollide) {
  ClaspedHand hand(geometry::make_sphere(kBall_m, 2000), at(0.095, 0.0, -0.3));
  hand.clasp.advance(open_hand());
  ASSERT_EQ(hand.clasp.state(), ClaspState::kClasping);
  hand.clasp.lose_track();
  hand.clasp.place_object(0, at(0.095, 0.0, 0.0));
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting) << "the ball is in the hand";
  hand.clasp.place_object(0, before_the_palm());
  Posture fist = bent_hand(0.9);
  hand.clasp.advance(fist);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping) << "the fist is in the ball, but the open hand was free";
  EXPECT_NE(hand.clasp.posture().values, fist.values);
}

TEST(LostHand, ResumesAtAnyFreeTarget) {
  ClaspedHand hand(geometry::make_plate({0.6, 0.6}, 200), at(0.1, 0.0, -0.08));
  hand.clasp.advance(open_hand());
  hand.clasp.lose_track();
  Posture beyond = open_hand();
  beyond.X_WR = at(0.0, 0.0, -0.3);
  hand.clasp.advance(beyond);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
  EXPECT_TRUE(hand.clasp.posture().X_WR.isApprox(beyond.X_WR));
}

}  // namespace
}  // namespace glissade::haptics
