// The stiffness with which parts are held, by the devices that may hold them.

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/devices/simulated_glove.h>

#include "expect_bad_input.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

devices::DeviceDescriptor device_with_damping(double damping) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.damping = damping;
  return device;
}

TEST(SessionStart, TellsWhichDeviceMakesContactsSofterAndWhy) {
  devices::DeviceDescriptor weak = devices::simulated_glove_descriptor();
  weak.name = "weak";
  weak.max_stiffness = 500.0;
  EXPECT_THAT(limits_of_devices({{devices::simulated_glove_descriptor()}}, {}, milliseconds(1)), IsEmpty());
  EXPECT_THAT(
      limits_of_devices({{weak}, {device_with_damping(0.3)}}, {}, milliseconds(1)),
      ElementsAre(AllOf(HasSubstr("weak"), HasSubstr("500 N/m instead of 1000"), HasSubstr("largest stiffness")),
                  AllOf(HasSubstr("600 N/m"), HasSubstr("passive"))));
}

TEST(SessionStart, DeviceWithoutRotationalDampingIsReportedAsSoftBesideTheReferencePoint) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.rotational_damping = 0.0;
  EXPECT_THAT(limits_of_devices({{device}}, {}, milliseconds(1)),
              ElementsAre(AllOf(HasSubstr("0.1 m beside the reference point"), HasSubstr("instead of 1000"),
                                HasSubstr("rotational stiffness"))));
  device.max_force = 0.0;
  EXPECT_THAT(limits_of_devices({{device}}, {}, milliseconds(1)), IsEmpty()) << "contacts exert nothing on the hand";
}

TEST(SessionStart, DeviceWhoseLinkMakesContactsHalfAsStiffIsReported) {
  devices::DeviceDescriptor stylus = devices::simulated_glove_descriptor();
  stylus.update_rate = 500.0;
  stylus.damping = 5.0;
  stylus.rotational_damping = 0.0;  // the stiffness without a link is the largest; 1 ms of lag becomes 3 ms
  const auto told = [&](bool has_links) { return limits_of_devices({{stylus}}, {}, milliseconds(1), has_links); };
  EXPECT_THAT(told(false), Not(Contains(HasSubstr("round trip"))));
  EXPECT_THAT(told(true), Contains(AllOf(HasSubstr("2.0 ms"), HasSubstr("333 N/m instead of 1000"))));
}

TEST(SessionStart, HandWhoseGloveHasNoJointsIsReported) {
  Grip grip{devices::simulated_glove_descriptor()};
  grip.fingers.emplace();
  EXPECT_THAT(limits_of_devices({grip}, {}, milliseconds(1)), IsEmpty());
  grip.device.joint_lower = grip.device.joint_upper = {};
  EXPECT_THAT(limits_of_devices({grip}, {}, milliseconds(1)), ElementsAre(HasSubstr("no joint")));
}

TEST(SessionStart, TheChosenStiffnessIsLoweredToThatOfTheDevice) {
  const Grip glove{devices::simulated_glove_descriptor(), 0};
  const double largest = glove.device.max_stiffness;
  const HapticScene scene =
      make_haptic_scene(parse_scene("objects:\n"
                                    "  - {name: part, movable: true, shape: {type: sphere}}\n"
                                    "  - {name: wall, shape: {type: box}, pose: {position_m: [6, 0, 0]}}\n",
                                    "scene", "."),
                        {"part"});
  const auto stiffness_with = [&](double wanted) {
    return start_simulation(scene, {glove}, {.stiffness_N_per_m = wanted}, {}).parts().stiffness(0);
  };
  EXPECT_DOUBLE_EQ(stiffness_with(50.0).translational, 50.0);
  EXPECT_DOUBLE_EQ(stiffness_with(2.0 * largest).translational, largest);
  EXPECT_DOUBLE_EQ(stiffness_with(50.0).rotational / stiffness_with(100.0).rotational, 0.5);
  EXPECT_THAT(limits_of_devices({glove}, {.stiffness_N_per_m = 50.0}, milliseconds(1)), IsEmpty());
  EXPECT_THAT(limits_of_devices({glove}, {.stiffness_N_per_m = 2.0 * largest}, milliseconds(1)),
              ElementsAre(HasSubstr("0.1 m beside the reference point"), HasSubstr("4000 N/m instead of 8000")));
  for (const double wrong : {9.0, 1.1e5})
    test_support::expect_bad_input([&] { stiffness_with(wrong); }, {"--stiffness", "between 10 and 100000"});
}

TEST(SessionStart, APartThatAnyHandMayTakeIsAsSoftAsTheWeakestDevice) {
  const HapticScene scene = make_haptic_scene(
      parse_scene("objects:\n"
                  "  - {name: first, movable: true, shape: {type: box}}\n"
                  "  - {name: second, movable: true, shape: {type: box}, pose: {position_m: [3, 0, 0]}}\n"
                  "  - {name: wall, shape: {type: box}, pose: {position_m: [6, 0, 0]}}\n",
                  "scene", "."),
      {"first", "second"});
  const grasping::GraspSimulation simulation =
      start_simulation(scene, {{device_with_damping(2.0), 0}, {device_with_damping(0.3)}}, {}, {});
  for (std::size_t part = 0; part < 2; ++part)
    EXPECT_DOUBLE_EQ(simulation.parts().stiffness(part).translational, 600.0) << part;
}

}  // namespace
}  // namespace glissade::apps
