// What callers must not do.

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>

#include "expect_bad_input.h"
#include "held_part.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;

TEST(HapticsPreconditions, AnOfflineRunNeedsASinkAndHandsThatCanHoldTheirParts) {
  const auto part = test_support::cube(0.1);
  const auto above = [] { return test_support::pose({0.0, 0.0, 0.2}); };
  devices::SimulatedGlove glove(geometry::PoseTrajectory({{std::chrono::nanoseconds(0), above()}}));
  const contact::PartScript script{geometry::PoseTrajectory({{std::chrono::nanoseconds(0), Isometry3d::Identity()}})};
  grasping::GraspSimulation sliding({}, {{.part_V = part, .X_WV_start = above()}, {.part_V = part, .script = script}});
  const auto ignore = [](const devices::HapticState&) {};
  EXPECT_THROW(run_offline({{&glove}}, sliding, 1, {}), std::invalid_argument);
  EXPECT_THROW(run_offline({{nullptr}}, sliding, 1, ignore), std::invalid_argument);
  EXPECT_THROW(run_offline({}, sliding, 1, ignore), std::invalid_argument);
  EXPECT_THROW(run_offline(std::vector<HandInLoop<devices::SimulatedGlove>>(5, {&glove}), sliding, 1, ignore),
               std::invalid_argument);
  EXPECT_THROW(run_offline({{&glove, 1}}, sliding, 1, ignore), std::invalid_argument) << "a script moves it";
  EXPECT_THROW(run_offline({{&glove, 2}}, sliding, 1, ignore), std::invalid_argument) << "there is none";
}

TEST(HapticsPreconditions, ALoopHasADeviceForEachHandOfItsSimulation) {
  const auto hand = std::make_shared<const grasping::HandModel>(grasping::make_hand());
  grasping::GraspSimulation simulation({}, {{.part_V = test_support::cube(0.1)}}, {hand, hand});
  devices::SimulatedGlove glove(geometry::PoseTrajectory({{std::chrono::nanoseconds(0), Isometry3d::Identity()}}));
  test_support::expect_bad_input([&] { run_offline({{&glove}}, simulation, 1, [](const devices::HapticState&) {}); },
                                 {"2 hands", "devices (1)"});
}

}  // namespace
}  // namespace glissade::haptics
