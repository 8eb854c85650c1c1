// Several hands and parts in one haptic loop: what each hand feels, and what grasps and releases do to it.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_kernel.h>
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
constexpr contact::CouplingStiffness kEachHand{1000.0, 1.0};
const double kArm = devices::SimulatedGloveParameters{}.wearer_stiffness;

/// A hand that goes straight from one place to another in half a second, and stays.
devices::SimulatedGlove hand(const Vector3d& p_from, const Vector3d& p_to) {
  return devices::SimulatedGlove(geometry::PoseTrajectory({{milliseconds(0), at(p_from.x(), p_from.y(), p_from.z())},
                                                           {milliseconds(500), at(p_to.x(), p_to.y(), p_to.z())}}));
}

contact::HeldPart cube_at(double x) {
  return {.part_V = cube(kEdge), .X_WV_start = at(x, 0.0, 0.0), .stiffness = kEachHand};
}

/// A run whose ticks are looked at one by one: no part collides, and no force jumps.
class SeveralHands : public ::testing::Test {
 protected:
  using Events = std::function<void(std::int64_t tick, HoldRequests& hands)>;

  std::vector<HapticState> run(const std::vector<HandInLoop<devices::SimulatedGlove>>& hands,
                               grasping::GraspSimulation& sliding, std::int64_t ticks, const Events& events = {},
                               const std::vector<contact::Obstacle>& obstacles = {}) {
    std::vector<HapticState> states;
    run_offline(hands, sliding, ticks,
                [&](const HapticState& state) {
                  expect_apart(state, sliding, obstacles);
                  if (!states.empty()) expect_no_jump(states.back(), state);
                  states.push_back(state);
                },
                {.before_tick = events});
    return states;
  }

 private:
  static void expect_apart(const HapticState& state, const grasping::GraspSimulation& sliding,
                           const std::vector<contact::Obstacle>& obstacles) {
    for (std::size_t a = 0; a < sliding.part_count(); ++a) {
      for (const contact::Obstacle& obstacle : obstacles) {
        ASSERT_FALSE(reference::brute_force_intersects(obstacle.body->tree.mesh(), sliding.parts().part(a).tree.mesh(),
                                                       obstacle.X_WO.inverse() * state.parts[a].X_WV))
            << obstacle.name << ", tick " << state.sequence;
      }
      for (std::size_t b = 0; b < a; ++b) {
        ASSERT_FALSE(reference::brute_force_intersects(sliding.parts().part(a).tree.mesh(),
                                                       sliding.parts().part(b).tree.mesh(),
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
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.01, 0.0, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.01, 0.0, 0.0});
  const HapticState last = run({{&left, 0}, {&right, 1}}, sliding, 1500).back();
  const double overlap = kEdge - 0.02;
  const double force = overlap / (2.0 / kArm + 2.0 / kEachHand.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), force, 0.02 * force);
  EXPECT_LT(last.hands[0].force_W.tail<2>().norm(), 1e-6);
  EXPECT_EQ(last.hands[0].part, 0);
  EXPECT_EQ(last.hands[1].part, 1);
}

TEST_F(SeveralHands, HandsThatLeadPartsApartFeelNothing) {
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.05, 0.02, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.05, 0.0, 0.03});
  for (const HapticState& state : run({{&left, 0}, {&right, 1}}, sliding, 600)) {
    ASSERT_EQ(state.hands[0].force_W, Vector3d::Zero());
    ASSERT_EQ(state.hands[1].torque_V_W, Vector3d::Zero());
  }
}

TEST_F(SeveralHands, APartThatNobodyHoldsIsAnObstacle) {
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(-0.03), cube_at(0.03)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {0.0, 0.0, 0.0});
  const HapticState last = run({{&left, 0}}, sliding, 1500).back();
  EXPECT_EQ(last.parts[1].X_WV.translation().x(), 0.03);
  EXPECT_EQ(last.parts[1].state, devices::PartState::kReleased);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), -0.01, 20e-6);
  const double force = 0.01 / (1.0 / kArm + 1.0 / kEachHand.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
}

TEST_F(SeveralHands, APartThatMovesOnItsOwnPushesTheHand) {
  const geometry::PoseTrajectory script(
      {{milliseconds(0), at(0.03, 0.0, 0.0)}, {milliseconds(1000), at(-0.03, 0.0, 0.0)}});
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(-0.03), contact::held_by_script({cube(kEdge), script})});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.03, 0.0, 0.0});
  const HapticState last = run({{&left, 0}}, sliding, 2000).back();
  EXPECT_NEAR(last.parts[1].X_WV.translation().x(), -0.03, 50e-6);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), -0.07, 100e-6);
  const double force = 0.04 / (1.0 / kArm + 1.0 / kEachHand.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.02 * force);
}

/// Both hands hold one cube and pull it apart by 20 mm: the springs of arms and couplings are in a row.
TEST_F(SeveralHands, TwoHandsOnOnePartFeelEachOther) {
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(0.0)});
  devices::SimulatedGlove left = hand({-0.03, 0.0, 0.0}, {-0.04, 0.0, 0.0});
  devices::SimulatedGlove right = hand({0.03, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const HapticState last = run({{&left, 0}, {&right, 0}}, sliding, 1500).back();
  const double force = 0.02 / (2.0 / kArm + 2.0 / kEachHand.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), force, 0.02 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), -force, 0.02 * force);
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), 0.0, 1e-4) << "in the middle of the two hands";
}

TEST_F(SeveralHands, TwoHandsThatPressOnePartShareTheForceOfItsContacts) {
  grasping::GraspSimulation sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove first = hand({-0.03, 0.0, 0.0}, {-0.01, 0.0, 0.0});
  devices::SimulatedGlove second = hand({-0.05, 0.0, 0.0}, {-0.03, 0.0, 0.0});
  const HapticState last = run({{&first, 0}, {&second, 0}}, sliding, 1500).back();
  EXPECT_NEAR(last.parts[0].X_WV.translation().x(), 0.01, 20e-6);
  const double force = 0.01 / (1.0 / kArm + 1.0 / kEachHand.translational);
  EXPECT_NEAR(last.hands[0].force_W.x(), -force, 0.03 * force);
  EXPECT_NEAR(last.hands[1].force_W.x(), -force, 0.03 * force);
}

TEST_F(SeveralHands, APartPassesFromHandToHand) {
  grasping::GraspSimulation sliding({wall(0.2)}, {cube_at(0.0)});
  devices::SimulatedGlove giver = hand({-0.03, 0.0, 0.0}, {0.07, 0.0, 0.0});
  devices::SimulatedGlove taker = hand({0.13, 0.0, 0.0}, {0.13, 0.0, 0.0});
  const auto states = run({{&giver, 0}, {&taker, std::nullopt}}, sliding, 1500, [](std::int64_t tick, auto& hands) {
    if (tick == 800) hands.grasp(1, 0);
    if (tick == 1000) hands.release(0);
  });
  EXPECT_EQ(states[700].hands[1].part, -1);
  EXPECT_EQ(states[900].hands[0].part, 0);
  EXPECT_EQ(states[900].hands[1].part, 0);
  EXPECT_EQ(states.back().hands[0].part, -1);
  EXPECT_EQ(states.back().parts[0].state, devices::PartState::kFree);
  EXPECT_NEAR(states.back().parts[0].X_WV.translation().x(), 0.1, 1e-3) << "stays where it was handed over";
}

TEST_F(SeveralHands, APartThatIsLetGoUnderForceStaysWhereItIsAndTheForceGoes) {
  grasping::GraspSimulation sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove glove = hand({0.0, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const auto states = run({{&glove, 0}}, sliding, 1400, [](std::int64_t tick, auto& hands) {
    if (tick == 1000) hands.release(0);
    if (tick == 1200) hands.grasp(0, 0);
  });
  EXPECT_LT(states[998].hands[0].force_W.x(), -5.0);
  EXPECT_EQ(states[1100].hands[0].force_W, Vector3d::Zero());
  EXPECT_EQ(states[1100].parts[0].X_WV.translation(), states[999].parts[0].X_WV.translation());
  // The new hold begins where the hand is then: the part follows it from there, and the old depth is forgotten.
  EXPECT_EQ(states.back().hands[0].part, 0);
  EXPECT_LT(std::abs(states.back().hands[0].force_W.x()), 3.0);
}

TEST_F(SeveralHands, AReleaseAndAGraspInOneTickAreBothKept) {
  grasping::GraspSimulation sliding({wall(0.03)}, {cube_at(0.0)});
  devices::SimulatedGlove glove = hand({0.0, 0.0, 0.0}, {0.04, 0.0, 0.0});
  const auto states = run({{&glove, 0}}, sliding, 1020, [](std::int64_t tick, auto& hands) {
    if (tick != 1000) return;
    hands.release(0);
    hands.grasp(0, 0);
  });
  EXPECT_LT(states[998].hands[0].force_W.x(), -5.0);
  EXPECT_EQ(states[1001].hands[0].part, 0);
  const double lag = (states[1001].parts[0].X_WG.translation() - states[1001].parts[0].X_WV.translation()).norm();
  EXPECT_LT(lag, 1e-3) << "the hand has taken hold anew, where the part is";
}

TEST_F(SeveralHands, AHandThatClosesTakesTheNearestPartAndOneThatOpensLetsGo) {
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(-0.06), cube_at(0.06)});
  devices::SimulatedGloveParameters parameters;
  parameters.starts_closed = false;
  parameters.grip_changes = {milliseconds(100), milliseconds(400), milliseconds(600)};
  devices::SimulatedGlove glove(
      geometry::PoseTrajectory({{milliseconds(0), at(0.03, 0.0, 0.0)}, {milliseconds(500), at(0.03, 0.05, 0.0)}}),
      parameters);
  const auto states = run({{&glove, 0}}, sliding, 800);
  EXPECT_EQ(states[50].hands[0].part, -1) << "open, whatever part it was given";
  EXPECT_EQ(states[200].hands[0].part, 1);
  EXPECT_EQ(states[500].hands[0].part, -1);
  EXPECT_EQ(states[700].hands[0].part, 1);
  EXPECT_GT(states.back().parts[1].X_WV.translation().y(), 0.02);
  EXPECT_EQ(states.back().parts[0].X_WV.translation().x(), -0.06);
}

/// A hand whose tracker fails no longer moves a part that another hand holds too.
TEST_F(SeveralHands, AHandThatIsLostLeavesThePartToTheOther) {
  grasping::GraspSimulation sliding({wall(1.0)}, {cube_at(0.0)});
  HapticKernel kernel(kernel_parts(sliding.parts()),
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

/// Two hands on one part, in free air, 2 mm apart from their first poses.
class TwoHandsOnOnePart : public ::testing::Test {
 protected:
  TwoHandsOnOnePart() {
    set_.parts[0].hold = 1;
    for (int i = 0; i < 500; ++i)
      tick();
  }

  /// A millisecond later; a hand that is silent tells nothing new.
  HapticTick tick() {
    ++ms_;
    for (devices::GloveState* const state : {&first_, &second_}) {
      if (is_silent_) break;
      state->sequence = ms_;
      state->time = milliseconds(ms_);
    }
    set_.time = milliseconds(ms_);
    const std::array<const devices::GloveState*, 2> states{&first_, &second_};
    return kernel_.tick(states, set_, milliseconds(ms_));
  }

  grasping::GraspSimulation sliding_{{wall(1.0)}, {cube_at(0.0), cube_at(0.5)}};
  HapticKernel kernel_{kernel_parts(sliding_.parts()),
                       {{devices::simulated_glove_descriptor(), 0}, {devices::simulated_glove_descriptor(), 0}}};
  ContactSet set_;
  devices::GloveState first_;
  devices::GloveState second_;
  std::int64_t ms_ = 0;
  bool is_silent_ = false;
};

TEST_F(TwoHandsOnOnePart, OneThatJumpsIsNotFeltByTheOther) {
  for (const double jump : {0.02, 0.1, 0.3}) {
    second_.X_WH.translation().y() += jump;
    for (int i = 0; i < 1000; ++i) {
      const HapticTick now = tick();
      ASSERT_LT(now.hands[0].pull.f.norm(), 0.01) << jump << " m, after " << i << " ms";
      ASSERT_LT(now.hands[0].command.values().f_H_W.norm(), 0.01);
    }
  }
}

TEST_F(TwoHandsOnOnePart, IfBothAreLostThePartStaysWhereItIs) {
  for (int i = 1; i <= 20; ++i) {
    first_.X_WH.translation().x() = -5e-4 * i;
    first_.v_WH.x() = -0.5;
    second_.X_WH.translation().x() = 5e-4 * i;
    second_.v_WH.x() = 0.5;
    tick();
  }
  is_silent_ = true;
  for (int i = 0; i < 300; ++i)
    ASSERT_NEAR(tick().ghosts.parts[0].X_WG.translation().x(), 0.0, 1e-9) << i;
}

TEST_F(TwoHandsOnOnePart, APartPassesFromHandToHandInOneTickWithoutALoss) {
  kernel_.release(1);
  tick();
  const GhostOfPart before = tick().ghosts.parts[0];
  kernel_.grasp(1, 0);
  kernel_.release(0);
  const HapticTick now = tick();
  EXPECT_FALSE(now.hands[0].part.has_value());
  EXPECT_EQ(now.hands[1].part, 0U);
  EXPECT_EQ(now.ghosts.parts[0].release, before.release) << "it was never let go";
  EXPECT_TRUE(now.ghosts.parts[0].is_held);
}

/// The force of the old part goes on for a moment, along the line on which it acted.
TEST_F(TwoHandsOnOnePart, AHandThatTakesAnotherPartFeelsNoNewTorque) {
  set_.row_count = 1;
  set_.row_array[0] = {{{Vector3d::UnitX(), Vector3d::Zero(), 0.0}}};
  kernel_.release(1);
  for (int i = 1; i <= 200; ++i) {
    set_.parts[0].hold = tick().ghosts.parts[0].hold;
    first_.X_WH.translation().x() = -1e-4 * std::min(100, i);
    first_.v_WH.x() = i <= 100 ? -0.1 : 0.0;
  }
  HandTick now = tick().hands[0];
  EXPECT_GT(now.command.values().f_H_W.x(), 5.0);
  EXPECT_LT(now.command.values().t_H_W.norm(), 1e-3);
  set_.parts[1].X_WV = at(0.0, 0.3, 0.0);
  kernel_.grasp(0, 1);
  for (int i = 0; i < 200; ++i) {
    now = tick().hands[0];
    ASSERT_LT(now.command.values().t_H_W.norm(), 1e-3) << i;
  }
  EXPECT_EQ(now.command.values().f_H_W, Vector3d::Zero());
}

/// A hand that wanders through a cube of 0.12 m, with a rest now and then.
devices::SimulatedGlove wandering_hand(std::uint64_t seed, std::chrono::seconds time) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-0.06, 0.06);
  std::uniform_real_distribution<double> angle(-0.4, 0.4);
  std::vector<geometry::TimedPose> rows;
  for (milliseconds now(0); now < time; now += milliseconds(200 + random() % 500)) {
    const bool rests = !rows.empty() && random() % 4 == 0;
    Isometry3d X_WH = at(coordinate(random), coordinate(random), coordinate(random));
    X_WH.rotate(Eigen::AngleAxisd(angle(random), Vector3d(angle(random), angle(random), 1.0).normalized()));
    rows.push_back({now, rests ? rows.back().X_WB : X_WH});
  }
  return devices::SimulatedGlove(geometry::PoseTrajectory(rows));
}

/// Grasps, releases and changes of hands at any moment: nothing collides, nothing jumps, and a hand that holds nothing
/// soon feels nothing. Ten minutes: GLISSADE_HAND_SECONDS=600.
TEST_F(SeveralHands, RandomGraspsAndReleasesCauseNoCollisionOrForceJump) {
  const char* const wish = std::getenv("GLISSADE_HAND_SECONDS");
  const int seconds = wish != nullptr ? std::atoi(wish) : 10;
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE(kSeed);
  const geometry::PoseTrajectory lift({{milliseconds(0), at(0.0, 0.0, -0.12)},
                                       {milliseconds(3000), at(0.0, 0.0, -0.07)},
                                       {milliseconds(6000), at(0.0, 0.0, -0.12)}});
  const std::vector<contact::Obstacle> obstacles{
      wall(0.09), test_support::obstacle_of(geometry::make_box({0.02, 0.3, 0.02}, 12), at(-0.1, 0.0, 0.0))};
  grasping::GraspSimulation sliding(
      obstacles,
      {cube_at(-0.03),
       cube_at(0.03),
       {.part_V = cube(kEdge), .X_WV_start = at(0.0, 0.07, 0.0), .metaphor = contact::Metaphor::kIncremental},
       contact::held_by_script({cube(kEdge), lift})},
      {}, {.sliding = {.friction = {.at_rest = 0.2, .sliding = 0.2}}});
  devices::SimulatedGlove first = wandering_hand(2 * kSeed, std::chrono::seconds(seconds));
  devices::SimulatedGlove second = wandering_hand(2 * kSeed + 1, std::chrono::seconds(seconds));
  std::mt19937_64 random(kSeed);
  std::array<std::optional<std::size_t>, 2> held{0, std::nullopt};
  std::array<std::int64_t, 2> free_since{0, 0};
  std::array<std::vector<std::pair<std::int64_t, std::optional<std::size_t>>>, 2> expected;
  int grasps = 0;
  const auto states = run(
      {{&first, 0}, {&second, std::nullopt}}, sliding, 1000 * seconds,
      [&](std::int64_t tick, auto& hands) {
        while (random() % 60 == 0) {  // sometimes several in one tick
          const std::size_t hand = random() % 2;
          if (random() % 3 == 0) {
            hands.release(hand);
            if (held[hand]) free_since[hand] = tick;
            held[hand].reset();
          } else {
            const std::size_t part = random() % 3;
            EXPECT_TRUE(hands.grasp(hand, part));
            held[hand] = part;
            ++grasps;
          }
        }
        for (std::size_t hand = 0; hand < 2; ++hand)
          expected[hand].emplace_back(free_since[hand], held[hand]);
      },
      obstacles);
  EXPECT_GT(grasps, 5 * seconds);
  double greatest = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const auto& [since, part] = expected[hand][i];
      const devices::HapticHandState& state = states[i].hands[hand];
      ASSERT_EQ(state.part, part ? static_cast<std::int32_t>(*part) : -1) << "hand " << hand << ", tick " << i + 1;
      greatest = std::max(greatest, state.force_W.norm());
      if (part || states[i].sequence - since < 80) continue;
      ASSERT_EQ(state.force_W, Vector3d::Zero()) << "hand " << hand << ", tick " << i + 1;
    }
  }
  EXPECT_GT(greatest, 5.0);
}

}  // namespace
}  // namespace glissade::haptics
