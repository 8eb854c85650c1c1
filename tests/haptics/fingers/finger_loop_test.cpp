/// Hands with fingers in the whole haptic loop: glove, haptic kernel, grasp simulation, and back, a millisecond a turn.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/recording.h>
#include <glissade/reference/grid_check.h>

#include "clasped_hand.h"
#include "closing_hand.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using devices::HapticState;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using grasping::ClaspRules;
using grasping::GraspSimulation;
using grasping::HandModel;
using grasping::LinkContact;
using hands::HandActivity;
using hands::JointValues;
using hands::kJoints;
using std::chrono::milliseconds;
using test_support::at;
using test_support::hand_chain;
using test_support::hand_model;

/// A ball in the open palm of a hand, and a wall beyond it, whose face is at 0.24 m.
struct BallAndWall {
  std::shared_ptr<const geometry::TriangleMesh> ball = test_support::ball_for_hand();
  std::shared_ptr<const geometry::TriangleMesh> wall =
      std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.02, 0.6, 0.6}, 2000));
  Isometry3d X_WBall = test_support::kBallInHand;
  Isometry3d X_WWall = at(0.25, 0.0, 0.0);

  GraspSimulation simulation(std::size_t hands, const contact::SlidingRules& rules = {},
                             const ClaspRules& clasp = {}) const {
    return {{{std::make_shared<const contact::ContactBody>(wall), X_WWall, "the wall"}},
            {{.part_V = std::make_shared<const contact::SlidingPart>(ball), .X_WV_start = X_WBall}},
            std::vector<std::shared_ptr<const HandModel>>(hands, hand_model()),
            {.clasp = clasp, .sliding = rules}};
  }

  /// Ball and visible hands, by a check without code of the trees.
  bool collides(const HapticState& state) const {
    const reference::GridCheck wall_only({{wall, X_WWall}});
    const reference::GridCheck all({{wall, X_WWall}, {ball, state.parts[0].X_WV}});
    if (wall_only.collides(*ball, state.parts[0].X_WV)) return true;
    std::vector<Isometry3d> X_WL(hand_chain()->links().size());
    for (std::size_t h = 0; h < static_cast<std::size_t>(state.hand_count); ++h) {
      const hands::VisibleHand& hand = state.hands[h].visible;
      if (hand.activity == HandActivity::kWaiting || hand.activity == HandActivity::kNone) continue;
      hand_chain()->poses(hand.X_WH, hand.angles, X_WL);
      for (std::size_t link = 0; link < X_WL.size(); ++link) {
        const auto& mesh = hand_chain()->links()[link].mesh;
        if (mesh != nullptr && all.collides(*mesh, X_WL[link])) return true;
      }
    }
    return false;
  }
};

/// A wearer whose open hand closes and opens at these times on the way of its root.
devices::SimulatedGlove glove_on(geometry::PoseTrajectory script_X_WR, std::vector<std::chrono::nanoseconds> grips) {
  devices::SimulatedGloveParameters wearer;
  wearer.grasp_posture = test_support::kClosedHand;
  wearer.open_posture = test_support::kOpenHand;
  wearer.starts_closed = false;
  wearer.grip_changes = std::move(grips);
  return devices::SimulatedGlove(std::move(script_X_WR), wearer);
}

/// At the ball, round which it closes at 0.2 s; 170 mm on, of which the wall leaves less; back, where it opens at
/// 2.2 s; away.
devices::SimulatedGlove carrier() {
  return glove_on(geometry::PoseTrajectory({{milliseconds(0), Isometry3d::Identity()},
                                            {milliseconds(700), Isometry3d::Identity()},
                                            {milliseconds(1200), at(0.17, 0.0, 0.0)},
                                            {milliseconds(1600), at(0.17, 0.0, 0.0)},
                                            {milliseconds(2000), at(0.02, 0.0, 0.03)},
                                            {milliseconds(2600), at(0.02, 0.0, 0.03)},
                                            {milliseconds(3000), at(0.02, 0.0, 0.2)}}),
                  {milliseconds(200), milliseconds(2200)});
}

std::vector<HapticState> run(GraspSimulation& simulation, std::vector<devices::SimulatedGlove>& gloves, int ticks,
                             LoopObserver* observer = nullptr) {
  std::vector<HandInLoop<devices::SimulatedGlove>> hands;
  for (devices::SimulatedGlove& glove : gloves)
    hands.push_back({&glove});
  std::vector<HapticState> states;
  run_offline(hands, simulation, ticks, [&](const HapticState& state) { states.push_back(state); },
              {.observer = observer});
  return states;
}

std::vector<HapticState> carried() {
  const BallAndWall scene;
  GraspSimulation simulation = scene.simulation(1);
  std::vector<devices::SimulatedGlove> gloves{carrier()};
  return run(simulation, gloves, 3200);
}

const std::vector<HapticState>& carry() {
  static const std::vector<HapticState> states = carried();
  return states;
}

const devices::HapticHandState& hand_at(int ms) {
  return carry()[static_cast<std::size_t>(ms)].hands[0];
}
Vector3d ball_at(int ms) {
  return carry()[static_cast<std::size_t>(ms)].parts[0].X_WV.translation();
}

TEST(FingerLoop, TakesHoldByTouchCarriesAndLetsGo) {
  EXPECT_EQ(hand_at(190).visible.activity, HandActivity::kFree);
  EXPECT_EQ(hand_at(190).part, -1);
  EXPECT_EQ(hand_at(650).visible.activity, HandActivity::kHolding);
  EXPECT_EQ(hand_at(650).visible.grasp, hands::GraspType::kPrecision);
  EXPECT_EQ(hand_at(650).part, 0);
  EXPECT_GT(ball_at(1550).x(), ball_at(650).x() + 0.1);
  EXPECT_EQ(hand_at(2500).visible.activity, HandActivity::kFree);
  EXPECT_EQ(hand_at(2500).part, -1);
  EXPECT_EQ(ball_at(2500), ball_at(3190)) << "it stays where it was left";
}

/// Looks at the point at which the coupling of the ball acts.
class GripWatch final : public LoopObserver {
 public:
  explicit GripWatch(const GraspSimulation& simulation) : simulation_(simulation) {}

  void after_tick(const TickRecord& /*record*/) noexcept override {}
  void after_answer(const AnswerRecord& record) noexcept override {
    const PartAnswer& ball = record.set.parts[0];
    const bool takes_hold = record.ghosts.parts[0].is_held && ball.hold != last_hold_;
    last_hold_ = ball.hold;
    if (!takes_hold) return;
    ++holds;
    Vector3d sum = Vector3d::Zero();
    for (const LinkContact& touch : simulation_.clasp(0).contacts())
      sum += touch.contact.q_W();
    const auto count = static_cast<double>(simulation_.clasp(0).contacts().size());
    from_own = std::max(from_own, ball.p_Vref.norm());
    from_grip = std::max(from_grip, (ball.X_WV * ball.p_Vref - sum / count).norm());
  }

  int holds = 0;
  double from_own = 0.0;   // metres; the ball's own point is its middle
  double from_grip = 0.0;  // from the middle of the contacts just after it was taken

 private:
  const GraspSimulation& simulation_;
  std::int64_t last_hold_ = 0;
};

TEST(FingerLoop, CouplesTheBallWhereItIsGripped) {
  const BallAndWall scene;
  GraspSimulation simulation = scene.simulation(1);
  std::vector<devices::SimulatedGlove> gloves{carrier()};
  GripWatch watch(simulation);
  run(simulation, gloves, 650, &watch);
  EXPECT_EQ(watch.holds, 1);
  EXPECT_GT(watch.from_own, 1e-3);
  EXPECT_LT(watch.from_grip, 0.3 * watch.from_own) << "a contact may have come or gone since the hand took hold";
}

TEST(FingerLoop, VisibleBodiesNeverCollide) {
  const BallAndWall scene;
  for (std::size_t i = 0; i < carry().size(); i += 4)
    ASSERT_FALSE(scene.collides(carry()[i])) << "after " << i << " ms";
}

TEST(FingerLoop, PressesTheHandAtTheWallAndTheFingersAtTheBallAndNowhereElse) {
  for (int ms = 0; ms < 200; ++ms) {
    ASSERT_EQ(hand_at(ms).joint_torques, JointValues{}) << ms;
    ASSERT_EQ(hand_at(ms).force_W, Vector3d::Zero().eval()) << ms;
  }
  EXPECT_NE(hand_at(650).joint_torques, JointValues{});
  EXPECT_LT(hand_at(650).force_W.norm(), 0.2) << "nothing but the wearer's grip holds the ball";
  EXPECT_LT(hand_at(1550).force_W.x(), -3.0) << "the wall";
  for (int ms = 2600; ms < 3200; ++ms) {
    ASSERT_EQ(hand_at(ms).joint_torques, JointValues{}) << ms;
    ASSERT_EQ(hand_at(ms).force_W, Vector3d::Zero().eval()) << ms;
  }
}

TEST(FingerLoop, ChangesNoForceAndNoTorqueFasterThanTheDeviceAllows) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  constexpr double kForcePeriods = 7.0;  // from zero to the maximum
  constexpr double kJointPeriods = 2.0;
  for (int ms = 1; ms < 3200; ++ms) {
    const Vector3d change = hand_at(ms).force_W - hand_at(ms - 1).force_W;
    ASSERT_LE(change.norm(), device.max_force / kForcePeriods * (1.0 + 1e-9)) << ms;
    ASSERT_LE(hand_at(ms).force_W.norm(), device.max_force * (1.0 + 1e-9)) << ms;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const double torque = hand_at(ms).joint_torques[joint];
      ASSERT_LE(std::abs(torque - hand_at(ms - 1).joint_torques[joint]),
                device.max_joint_torque / kJointPeriods * (1.0 + 1e-9))
          << ms;
      ASSERT_LE(std::abs(torque), device.max_joint_torque) << ms;
    }
  }
}

TEST(FingerLoop, PassesThePartFromHandToHand) {
  const BallAndWall scene;
  GraspSimulation simulation = scene.simulation(2);
  // The second hand comes from below, upside down, and finds the ball in the first one as that has it.
  const Vector3d p_in_hand = scene.X_WBall.translation();
  const Isometry3d X_WSecond = Eigen::Translation3d(p_in_hand) *
                               Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()) *
                               Eigen::Translation3d(-p_in_hand);
  std::vector<devices::SimulatedGlove> gloves{
      glove_on(geometry::PoseTrajectory({{milliseconds(0), Isometry3d::Identity()}}),
               {milliseconds(200), milliseconds(2000)}),
      glove_on(geometry::PoseTrajectory({{milliseconds(0), at(0.0, 0.0, -0.2) * X_WSecond},
                                         {milliseconds(800), at(0.0, 0.0, -0.2) * X_WSecond},
                                         {milliseconds(1200), X_WSecond},
                                         {milliseconds(2600), X_WSecond},
                                         {milliseconds(3000), at(0.0, 0.0, -0.05) * X_WSecond}}),
               {milliseconds(1300)})};
  const std::vector<HapticState> states = run(simulation, gloves, 3200);
  ASSERT_TRUE(states[1000].parts[0].X_WV.translation().isApprox(p_in_hand, 0.3)) << "the test's own premise";
  EXPECT_EQ(states[1000].hands[0].part, 0);
  EXPECT_EQ(states[1000].hands[1].part, -1);
  EXPECT_EQ(states[1900].hands[0].part, 0) << "both hold it";
  EXPECT_EQ(states[1900].hands[1].part, 0);
  EXPECT_EQ(states[2500].hands[0].part, -1);
  EXPECT_EQ(states[2500].hands[1].part, 0);
  EXPECT_LT(states[3150].parts[0].X_WV.translation().z(), states[2500].parts[0].X_WV.translation().z() - 0.03);
  for (std::size_t i = 0; i < states.size(); i += 10)
    ASSERT_FALSE(scene.collides(states[i])) << "after " << i << " ms";
}

/// The recording of a hand that carries, and what repeats it.
RecordingHead recording_head() {
  return {.gloves = {{.device = 1, .session = 1, .descriptor = devices::simulated_glove_descriptor()}}, .events = {}};
}

std::vector<devices::LogEvent> recorded_carry(const BallAndWall& scene, int ticks) {
  class Events final : public LoopObserver {
   public:
    void after_tick(const TickRecord& record) noexcept override {
      for (devices::LogEvent& event : events_.of(record))
        all.push_back(std::move(event));
    }
    void after_answer(const AnswerRecord& record) noexcept override { all.push_back(RecordedEvents::of(record)); }
    std::vector<devices::LogEvent> all;

   private:
    RecordedEvents events_{recording_head()};
  };
  Events events;
  GraspSimulation simulation = scene.simulation(1);
  std::vector<devices::SimulatedGlove> gloves{carrier()};
  run(simulation, gloves, ticks, &events);
  return std::move(events.all);
}

TEST(FingerLoop, ReplayIsBitIdentical) {
  const BallAndWall scene;
  const std::vector<devices::LogEvent> events = recorded_carry(scene, 2500);
  GraspSimulation simulation = scene.simulation(1);
  Replay replay(simulation, {{.device = devices::simulated_glove_descriptor()}}, kTickPeriod, recording_head());
  for (const devices::LogEvent& event : events)
    ASSERT_TRUE(replay.take(event)) << replay.difference();
  EXPECT_TRUE(replay.finish()) << replay.difference();
  EXPECT_EQ(replay.ticks(), 2500);
}

// Hands stand still while the parts are within a step; so they must come to move all the same, and the steps to an end.
// The hand itself has work enough: with a sixteenth of this budget it closes so slowly that it pushes the ball away.
TEST(FingerLoop, CarriesThePartWithASmallWorkBudget) {
  const BallAndWall scene;
  GraspSimulation simulation = scene.simulation(1, {.work_budget = 30'000}, {.work_budget = 200'000});
  std::vector<devices::SimulatedGlove> gloves{carrier()};
  const std::vector<HapticState> states = run(simulation, gloves, 3200);
  EXPECT_GT(simulation.parts().call_statistics().ended_early, 50);
  EXPECT_EQ(states[1550].hands[0].part, 0);
  EXPECT_GT(states[1550].parts[0].X_WV.translation().x(), states[650].parts[0].X_WV.translation().x() + 0.09);
  EXPECT_EQ(states[2700].hands[0].part, -1);
  for (std::size_t i = 0; i < states.size(); i += 10)
    ASSERT_FALSE(scene.collides(states[i])) << "after " << i << " ms";
}

// Each joint that is stopped rests as deep as its muscle presses into the spring, with less than a degree at the
// device's largest torque.
TEST(FingerLoop, StopsFingersWithinADegreeOfTheVisibleOnes) {
  const HapticState& state = carry()[650];
  const HapticState& earlier = carry()[600];
  const BallAndWall scene;
  int stopped = 0;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const double torque = state.hands[0].joint_torques[joint];
    const double moved = state.hands[0].visible.angles[joint] - earlier.hands[0].visible.angles[joint];
    if (torque == 0.0 || std::abs(moved) > 0.01) continue;  // the thumb still slides round the ball
    // What the muscles want less what they get is the angle of the glove.
    const double muscle = devices::SimulatedGloveParameters{}.finger_stiffness;
    const double glove = test_support::kClosedHand[joint] + torque / muscle;
    EXPECT_NEAR(glove, state.hands[0].visible.angles[joint], std::numbers::pi / 180.0) << joint;
    HapticState deeper = state;
    deeper.hands[0].visible.angles[joint] -= std::copysign(std::numbers::pi / 180.0, torque);
    stopped += scene.collides(deeper) ? 1 : 0;
  }
  EXPECT_GE(stopped, 3) << "joints that a degree more would bring into the ball";
}

TEST(FingerLoop, GripAloneHoldsNothing) {
  const BallAndWall scene;
  GraspSimulation simulation = scene.simulation(1);
  // Far from the ball, the hand closes and opens.
  std::vector<devices::SimulatedGlove> gloves{
      glove_on(geometry::PoseTrajectory({{milliseconds(0), at(0.0, 0.0, 0.15)}}), {milliseconds(50)})};
  for (const HapticState& state : run(simulation, gloves, 400))
    ASSERT_EQ(state.hands[0].part, -1);
}

}  // namespace
}  // namespace glissade::haptics
