// A recorded run of an arm that holds half-spaces by itself can be repeated to the bit.

#include <algorithm>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <glissade/devices/event_log.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/recording.h>
#include <glissade/lcmtypes/haptic_tick_t.hpp>

#include "rubbed_box.h"
#include "temporary_folder.h"

namespace glissade::haptics {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kRunTicks = 600;

TEST(RecordedHalfSpaces, RepeatToTheBit) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("arm.lcmlog");
  devices::SimulatedGlove arm(geometry::PoseTrajectory({{milliseconds(0), test_support::at(0.0, 0.0, 0.0)},
                                                        {milliseconds(300), test_support::at(0.04, 0.01, 0.0)}}),
                              {}, holding_arm());
  const auto pushed_cube = [] {
    return grasping::GraspSimulation(
        {test_support::wall(0.03)},
        {{.part_V = test_support::cube(0.04), .stiffness = contact::CouplingStiffness{1000.0, 1.0}}});
  };
  const RecordingHead head{.gloves = {{.device = 1, .session = 1, .descriptor = arm.descriptor()}}};
  {
    LogRecorder recorder(path, head);
    grasping::GraspSimulation cube = pushed_cube();
    run_offline({{&arm}}, cube, kRunTicks, [](const devices::HapticState&) {}, {.observer = &recorder});
    recorder.close();
  }
  devices::EventLogReader log(path);
  grasping::GraspSimulation cube = pushed_cube();
  Replay replay(cube, {{.device = arm.descriptor(), .part = 0}}, kTickPeriod, head);
  std::int32_t most_rows = 0;
  while (const auto event = log.next()) {
    replay.take(*event);
    haptic_tick_t tick;
    if (event->channel != "HAPTIC_TICK") continue;
    ASSERT_GT(tick.decode(event->message.data(), 0, static_cast<int>(event->message.size())), 0);
    for (const half_spaces_t& half_spaces : tick.half_spaces)
      most_rows = std::max(most_rows, half_spaces.count);
  }
  replay.finish();
  EXPECT_EQ(log.damage() + replay.difference(), "");
  EXPECT_EQ(replay.ticks(), kRunTicks);
  EXPECT_GT(most_rows, 0) << "the record has the half-spaces";
}

}  // namespace
}  // namespace glissade::haptics
