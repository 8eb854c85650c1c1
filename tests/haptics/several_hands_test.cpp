// Several hands and parts in one haptic loop: what each hand feels, and what grasps and releases do to it.

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/multi_part_sliding.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/reference/brute_force.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using devices::HapticState;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using test_support::at;
using test_support::cube;
using test_support::wall;

constexpr double kEdge = 0.04;
constexpr CouplingStiffness kHandStiffness{1000.0, 1.0};
const double kArm = devices::SimulatedGloveParameters{}.wearer_stiffness;

/// A hand that goes straight from one place to another in half a second, and stays.
devices::SimulatedGlove hand(const Vector3d& p_from, const Vector3d& p_to) {
  return devices::SimulatedGlove(geometry::PoseTrajectory({{milliseconds(0), at(p_from.x(), p_from.y(), p_from.z())},
                                                           {milliseconds(500), at(p_to.x(), p_to.y(), p_to.z())}}));
}

HeldPart cube_at(double x) {
  return {.part_V = cube(kEdge), .X_WV_start = at(x, 0.0, 0.0), .stiffness = kHandStiffness};
}

/// A run whose ticks are looked at one by one: no part collides, and no force jumps.
class SeveralHands : public ::testing::Test {
 protected:
  using Events = std::function<void(std::int64_t tick, HapticKernel& kernel)>;

  std::vector<HapticState> run(const std::vector<HandOffline>& hands, MultiPartSliding& sliding, std::int64_t ticks,
                               const Events& events = {}) {
    std::vector<HapticState> states;
    run_offline(hands, sliding, ticks,
                [&](const HapticState& state) {
                  expect_apart(state, sliding);
                  if (!states.empty()) expect_no_jump(states.back(), state);
                  states.push_back(state);
                },
                {.before_tick = events});
    return states;
  }

 private:
  static void expect_apart(const HapticState& state, const MultiPartSliding& sliding) {
    for (std::size_t a = 0; a < sliding.part_count(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        ASSERT_FALSE(reference::brute_force_intersects(sliding.part(a).tree.mesh(), sliding.part(b).tree.mesh(),
                                                       state.parts[a].X_WV.inverse() * state.parts[b].X_WV))
            << "tick " << state.sequence;
      }
    }
  }

  static void expect_no_jump(const HapticState& before, const HapticState& now) {
    constexpr double kSlew = 20.0 / 7.0;  // N in a period of the simulated glove
    for (std::size_t h = 0; h < static_cast<std::size_t>(now.hand_count); ++h) {
      ASSERT_LE((now.hands[h].force_W - before.hands[h].force_W).norm(), kSlew * (1.0 + 1e-9))
          << "hand " << h << ", tick " << now.sequence;
    }
  }
};

/// Springs in a row: both arms, and both couplings.
TEST_F(SeveralHands, TwoPartsPressedTogetherPushBothHandsAlike) {
  MultiPartSliding sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.01, 0.0, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.01, 0.0, 0.0});
  const HapticState last = run({{&left, 0}, {&right, 1}}, sliding, 1500).back();
  const double overlap = kEdge - 0.02;
  const double force = overlap / (2.0 / kArm + 2.0 / kHandStiffness.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), force, 0.02 * force);
  EXPECT_LT(last.hands[0].force_W.tail<2>().norm(), 1e-6);
  EXPECT_EQ(last.hands[0].part, 0);
  EXPECT_EQ(last.hands[1].part, 1);
}

TEST_F(SeveralHands, HandsThatLeadPartsApartFeelNothing) {
  MultiPartSliding sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.05, 0.02, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.05, 0.0, 0.03});
  for (const HapticState& state : run({{&left, 0}, {&right, 1}}, sliding, 600)) {
    ASSERT_EQ(state.hands[0].force_W, Vector3d::Zero());
    ASSERT_EQ(state.hands[1].torque_V_W, Vector3d::Zero());
  }
}

TEST_F(SeveralHands, APartThatNobodyHoldsIsAnObstacle) {
  MultiPartSliding sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {0.0, 0.0, 0.0});
  const HapticState last = run({{&left, 0}}, sliding, 1500).back();
  EXPECT_EQ(last.parts[1].X_WV.translation().x(), 0.03);
  EXPECT_EQ(last.parts[1].state, devices::PartState::kReleased);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), -0.01, 20e-6);
  const double force = 0.01 / (1.0 / kArm + 1.0 / kHandStiffness.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
}

TEST_F(SeveralHands, APartThatMovesOnItsOwnPushesTheHand) {
  const geometry::PoseTrajectory script(
      {{milliseconds(0), at(0.03, 0.0, 0.0)}, {milliseconds(1000), at(-0.03, 0.0, 0.0)}});
  MultiPartSliding sliding({wall(1.0)}, {cube_at(-0.03), held_by_script({cube(kEdge), script})});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.03, 0.0, 0.0});
  const HapticState last = run({{&left, 0}}, sliding, 2000).back();
  EXPECT_NEAR(last.parts[1].X_WV.translation().x(), -0.03, 50e-6);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), -0.07, 100e-6);
  const double force = 0.04 / (1.0 / kArm + 1.0 / kHandStiffness.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
}

/// Both hands hold one cube and pull it apart by 20 mm: the springs of arms and couplings are in a row.
TEST_F(SeveralHands, TwoHandsOnOnePartFeelEachOther) {
  MultiPartSliding sliding({wall(1.0)}, {cube_at(0.0)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.04, 0.0, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const HapticState last = run({{&left, 0}, {&right, 0}}, sliding, 1500).back();
  const double force = 0.02 / (2.0 / kArm + 2.0 / kHandStiffness.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), force, 0.02 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), -force, 0.02 * force);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), 0.0, 1e-4) << "in the middle of the two hands";
}

TEST_F(SeveralHands, TwoHandsThatPressOnePartShareTheForceOfItsContacts) {
  MultiPartSliding sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove first = hand({-0.03, 0.0, 0.0}, {-0.01, 0.0, 0.0});
  devices::SimulatedGlove second = hand({-0.05, 0.0, 0.0}, {-0.03, 0.0, 0.0});
  const HapticState last = run({{&first, 0}, {&second, 0}}, sliding, 1500).back();
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), 0.01, 20e-6);
  const double force = 0.01 / (1.0 / kArm + 1.0 / kHandStiffness.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.03 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), -force, 0.03 * force);
}

TEST_F(SeveralHands, APartPassesFromHandToHand) {
  MultiPartSliding sliding({wall(0.2)}, {cube_at(0.0)});
  devices::SimulatedGlove giver = hand({-0.03, 0.0, 0.0}, {0.07, 0.0, 0.0});
  devices::SimulatedGlove taker = hand({0.13, 0.0, 0.0}, {0.13, 0.0, 0.0});
  const auto states = run({{&giver, 0}, {&taker, std::nullopt}}, sliding, 1500, [](std::int64_t tick, auto& kernel) {
    if (tick == 800) kernel.grasp(1, 0);
    if (tick == 1000) kernel.release(0);
  });
  EXPECT_EQ(states[700].hands[1].part, -1);
  EXPECT_EQ(states[900].hands[0].part, 0);
  EXPECT_EQ(states[900].hands[1].part, 0);
  EXPECT_EQ(states.back().hands[0].part, -1);
  EXPECT_EQ(states.back().parts[0].state, devices::PartState::kFree);
  EXPECT_NEAR(states.back().parts[0].X_WV.translation().x(), 0.1, 1e-3) << "stays where it was handed over";
}

TEST_F(SeveralHands, APartThatIsLetGoUnderForceStaysWhereItIsAndTheForceGoes) {
  MultiPartSliding sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove glove = hand({0.0, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const auto states = run({{&glove, 0}}, sliding, 1400, [](std::int64_t tick, auto& kernel) {
    if (tick == 1000) kernel.release(0);
    if (tick == 1200) kernel.grasp(0, 0);
  });
  EXPECT_LT(states[998].hands[0].force_W.x(), -5.0);
  EXPECT_EQ(states[1100].hands[0].force_W, Vector3d::Zero());
  EXPECT_EQ(states[1100].parts[0].X_WV.translation(), states[999].parts[0].X_WV.translation());
  // The new hold begins where the hand is then: the part follows it from there, and the old depth is forgotten.
  EXPECT_EQ(states.back().hands[0].part, 0);
  EXPECT_LT(std::abs(states.back().hands[0].force_W.x()), 3.0);
}

TEST_F(SeveralHands, AReleaseAndAGraspInOneTickAreBothKept) {
  MultiPartSliding sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove glove = hand({0.0, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const auto states = run({{&glove, 0}}, sliding, 1020, [](std::int64_t tick, auto& kernel) {
    if (tick != 1000) return;
    kernel.release(0);
    kernel.grasp(0, 0);
  });
  EXPECT_LT(states[998].hands[0].force_W.x(), -5.0);
  EXPECT_EQ(states[1001].hands[0].part, 0);
  const double lag = (states[1001].parts[0].X_WG.translation() - states[1001].parts[0].X_WV.translation()).norm();
  EXPECT_LT(lag, 1e-3) << "the hand has taken hold anew, where the part is";
}

/// A hand whose tracker fails no longer moves a part that another hand holds too.
TEST_F(SeveralHands, AHandThatIsLostLeavesThePartToTheOther) {
  MultiPartSliding sliding({wall(1.0)}, {cube_at(0.0)});
  HapticKernel kernel(kernel_parts(sliding),
                      {{devices::simulated_glove_descriptor(), 0}, {devices::simulated_glove_descriptor(), 0}});
  ContactSet set;
  set.parts[0].hold = 1;
  devices::GloveState kept;
  devices::GloveState lost;
  Vector3d force = Vector3d::Zero();
  for (int ms = 1; ms <= 1000; ++ms) {
    kept.sequence = ms;
    kept.time = milliseconds(ms);
    kept.X_WH = at(std::min(0.01, 1e-4 * (ms - 1)), 0.0, 0.0);
    kept.v_WH.x() = ms <= 101 ? 0.1 : 0.0;
    if (ms <= 400) {
      lost.sequence = ms;
      lost.time = milliseconds(ms);
    }
    set.time = milliseconds(ms);
    const std::array<const devices::GloveState*, 2> states{&kept, &lost};
    const HapticTick tick = kernel.tick(states, set, milliseconds(ms));
    const Vector3d now = tick.hands[0].command.values().f_H_W;
    ASSERT_LE((now - force).norm(), 20.0 / 7.0 * (1.0 + 1e-9)) << ms;
    force = now;
    if (ms == 400) {
      EXPECT_NEAR(tick.ghosts.parts[0].X_WG.translation().x(), 0.005, 1e-6) << "between the hands";
      EXPECT_NEAR(force.x(), -5.0, 1e-3) << "the pull of the other";
    }
    if (ms == 600) {
      EXPECT_NEAR(tick.ghosts.parts[0].X_WG.translation().x(), 0.01, 1e-9);
      EXPECT_EQ(force, Vector3d::Zero());
      EXPECT_EQ(tick.hands[1].command.values().f_H_W, Vector3d::Zero());
    }
  }
}

}  // namespace
}  // namespace glissade::haptics
