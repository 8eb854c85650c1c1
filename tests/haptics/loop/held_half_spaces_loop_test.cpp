/// The whole loop with an arm behind a slow link: 60 states and commands a second, 20 ms on the way there and back. The
/// arm holds the half-spaces of the box that its hand presses on a plate.

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include <glissade/haptics/offline_run.h>

#include "rubbed_box.h"

namespace glissade::haptics {
namespace {

using std::chrono::milliseconds;

devices::GloveModel behind_slow_link(devices::GloveModel arm) {
  arm.update_rate = 60.0;
  arm.link.delay = 10e-3;
  arm.wrist.loop_delay = 1e-3;
  return arm;
}

TEST(HeldHalfSpacesInTheLoop, HandRestsWhereTheSpringsBalance) {
  RubbedBox box(behind_slow_link(holding_arm()), 0.0);
  DisturbedLoop loop(box, {});
  double least = 1.0;
  double greatest = -1.0;
  double stiffness = 0.0;
  loop.run(
      milliseconds(5000), [](auto, const auto&, const auto&) {},
      [&](std::chrono::nanoseconds now, const devices::GloveCommand& command, const devices::GloveState&) {
        if (now < milliseconds(2000)) return;
        const double z = box.glove().true_state().X_WH.translation().z();
        least = std::min(least, z);
        greatest = std::max(greatest, z);
        stiffness = command.half_spaces.stiffness;
      });
  EXPECT_LT(greatest - least, 20e-6) << "no limit cycle while the hand rubs to and fro";
  EXPECT_NEAR(stiffness, 1000.0, 1e-6) << "all that is wanted; a wrench over this link is passive up to 71 N/m";
  const double wearer = devices::SimulatedGloveParameters().wearer_stiffness;
  const double depth = wearer / (wearer + stiffness) * RubbedBox::kAim;
  EXPECT_NEAR(0.5 * RubbedBox::kEdge - least, depth, 0.01 * depth);
}

// The half-spaces of B move with its own hand, by way of the part of A, and a period late.
TEST(HeldHalfSpacesInTheLoop, HandsThatPressTheirPartsTogetherComeToRest) {
  using test_support::at;
  constexpr double kEdge = 0.04;
  const auto pressing = [](double sign) {
    const double start = sign * (0.5 * kEdge + 1e-3);
    return geometry::PoseTrajectory({{milliseconds(0), at(start)},
                                     {milliseconds(1500), at(start - 0.05 * sign)},
                                     {milliseconds(20000), at(start - 0.05 * sign)}});
  };
  const devices::SimulatedGloveParameters light{.mass = 0.2, .wearer_stiffness = 200.0, .wearer_damping = 3.0};
  devices::GloveModel arm = holding_arm();
  arm.update_rate = 30.0;
  devices::SimulatedGlove glove_A(pressing(-1.0), light);
  devices::SimulatedGlove glove_B(pressing(1.0), light, arm);
  grasping::GraspSimulation sliding{{},
                                    {{.part_V = test_support::cube(kEdge), .X_WV_start = at(-0.5 * kEdge - 1e-3)},
                                     {.part_V = test_support::cube(kEdge), .X_WV_start = at(0.5 * kEdge + 1e-3)}}};
  double least = 1.0;
  double greatest = -1.0;
  run_offline({{&glove_A, 0}, {&glove_B, 1}}, sliding, 20000, [&](const devices::HapticState& state) {
    if (state.time < milliseconds(15000)) return;
    const double x = glove_B.true_state().X_WH.translation().x();
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  });
  EXPECT_LT(greatest - least, 0.1e-3);
  EXPECT_GT(least, 0.5 * kEdge + 1e-3 - 0.05) << "the part of A holds the hand back";
}

// An arm that takes a wrench over this link is as soft as the link demands. With the stiffness for an arm without a
// link, it would swing.
TEST(HeldHalfSpacesInTheLoop, AnArmThatTakesAWrenchOverALinkComesToRest) {
  using test_support::at;
  devices::GloveModel arm = holding_arm();
  arm.wrist.holds_half_spaces = false;
  arm.link.delay = 15e-3;
  constexpr double kEdge = 0.04;
  const auto start = at(0.0, 0.0, 0.5 * kEdge + 1e-3);
  const devices::SimulatedGloveParameters light{.mass = 0.2, .wearer_stiffness = 200.0, .wearer_damping = 3.0};
  devices::SimulatedGlove glove(
      geometry::PoseTrajectory({{milliseconds(0), start}, {milliseconds(1000), at(0.0, 0.0, 0.0)}}), light, arm);
  grasping::GraspSimulation sliding{{test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 2))},
                                    {{.part_V = test_support::cube(kEdge), .X_WV_start = start}}};
  double least = 1.0;
  double greatest = -1.0;
  double stiffness = 0.0;
  run_offline({{&glove}}, sliding, 8000, [&](const devices::HapticState& state) {
    if (state.time < milliseconds(6000)) return;
    const double z = glove.true_state().X_WH.translation().z();
    least = std::min(least, z);
    greatest = std::max(greatest, z);
    stiffness = state.hands[0].force_W.z() / (state.parts[0].X_WV.translation().z() - z);
  });
  EXPECT_LT(greatest - least, 20e-6);
  EXPECT_NEAR(stiffness, 2.0 / (0.5e-3 + 30e-3), 10.0) << "damping over half a period and the way there and back";
}

// What a wrench would be over the same link.
TEST(HeldHalfSpacesInTheLoop, StiffnessIsThatOfTheOwnLoop) {
  devices::GloveModel arm = behind_slow_link(holding_arm());
  const contact::CouplingStiffness held = passive_stiffness(devices::descriptor_of(arm), kTickPeriod, {});
  arm.wrist.holds_half_spaces = false;
  const contact::CouplingStiffness forced = passive_stiffness(devices::descriptor_of(arm), kTickPeriod, {});
  EXPECT_NEAR(held.translational, 2.0 / 1.5e-3, 1e-6);
  EXPECT_NEAR(forced.translational, 2.0 / (0.5 / 60.0 + 20e-3), 1e-6);
}

}  // namespace
}  // namespace glissade::haptics
