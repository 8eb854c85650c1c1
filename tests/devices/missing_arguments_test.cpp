#include <chrono>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/realtime/clock.h>

#include "expect_bad_input.h"

namespace glissade::devices {
namespace {

using test_support::expect_bad_input;

TEST(MissingArguments, ABusIsNeededByEveryEndOfALink) {
  expect_bad_input([] { const LcmGlove glove(nullptr, simulated_glove_descriptor()); }, {"needs an LCM bus"});
  expect_bad_input([] { const LcmGloveHost host(nullptr, simulated_glove_descriptor()); }, {"needs an LCM bus"});
  expect_bad_input([] { const HapticStatePublisher publisher(nullptr); }, {"needs an LCM bus"});
  realtime::SteadyClock clock;
  const geometry::PoseTrajectory script({geometry::TimedPose{}});
  expect_bad_input([&] { const SimulatedGloveService service(nullptr, SimulatedGlove(script), clock); },
                   {"needs an LCM bus"});
}

TEST(MissingArguments, ASubscriptionNeedsAHandler) {
  LcmBus bus("memq://");
  expect_bad_input([&] { static_cast<void>(bus.subscribe("CHANNEL", {})); }, {"'CHANNEL'", "needs a handler"});
}

}  // namespace
}  // namespace glissade::devices
