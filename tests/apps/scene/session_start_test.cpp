// The stiffness with which parts are held, by the devices that may hold them.

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/multi_part_sliding.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

devices::DeviceDescriptor device_with_damping(double damping) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.damping = damping;
  return device;
}

TEST(SessionStart, TellsWhichDeviceMakesContactsSofterAndWhy) {
  devices::DeviceDescriptor weak = devices::simulated_glove_descriptor();
  weak.name = "weak";
  weak.max_stiffness = 500.0;
  EXPECT_THAT(softer_devices({{devices::simulated_glove_descriptor()}}, milliseconds(1)), IsEmpty());
  EXPECT_THAT(
      softer_devices({{weak}, {device_with_damping(0.3)}}, milliseconds(1)),
      ElementsAre(AllOf(HasSubstr("weak"), HasSubstr("500 N/m instead of 1000"), HasSubstr("largest stiffness")),
                  AllOf(HasSubstr("600 N/m"), HasSubstr("passive"))));
}

TEST(SessionStart, APartThatAnyHandMayTakeIsAsSoftAsTheWeakestDevice) {
  const HapticScene scene = make_haptic_scene(
      parse_scene("objects:\n"
                  "  - {name: first, movable: true, shape: {type: box}}\n"
                  "  - {name: second, movable: true, shape: {type: box}, pose: {position_m: [3, 0, 0]}}\n"
                  "  - {name: wall, shape: {type: box}, pose: {position_m: [6, 0, 0]}}\n",
                  "scene", "."),
      {"first", "second"});
  const StartedSimulation started =
      start_simulation(scene, {{device_with_damping(2.0), 0}, {device_with_damping(0.3)}}, {}, {});
  for (std::size_t part = 0; part < 2; ++part)
    EXPECT_DOUBLE_EQ(started.simulation->parts().stiffness(part).translational, 600.0) << part;
}

}  // namespace
}  // namespace glissade::apps
