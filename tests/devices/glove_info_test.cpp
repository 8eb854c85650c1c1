/// How gloves are found: their announcements.

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>

#include "glove_link_fixture.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

TEST(GloveInfo, IsAnnouncedWithTheDescriptor) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  DeviceDescriptor descriptor = simulated_glove_descriptor();
  descriptor.name = "a glove whose name has more than 31 letters";
  descriptor.max_mean_force = 4.0;
  descriptor.joint_damping = 0.03;
  descriptor.joint_friction = 0.004;
  descriptor.joint_resolution = 2e-3;
  descriptor.frozen = milliseconds(50);
  descriptor.finger_command = FingerCommand::kCurlLimit;
  descriptor.limit_rate = 50.0;
  descriptor.limit_delay = milliseconds(7);
  descriptor.max_limit_stiffness = 3.0;
  descriptor.undriven_joints.set(0).set(hands::kJoints - 1);
  descriptor.tool_command = ToolCommand::kHalfSpaces;
  descriptor.tool_rate = 2000.0;
  descriptor.tool_delay = milliseconds(2);
  LcmGloveHost host(bus, descriptor, {.device = 3, .side = hands::HandSide::kLeft});
  GloveSearch search(bus);
  std::atomic<bool> should_end{false};
  std::thread driver([&] {
    while (!should_end) {
      host.publish({});
      std::this_thread::sleep_for(milliseconds(1));
    }
  });
  EXPECT_FALSE(search.wait_for(4, milliseconds(300)).has_value());
  const std::optional<GloveInfo> found = search.wait_for(3, std::chrono::seconds(10));
  should_end = true;
  driver.join();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->side, hands::HandSide::kLeft);
  EXPECT_EQ(found->descriptor.name, "a glove whose name has more tha");
  EXPECT_EQ(found->descriptor.max_mean_force, 4.0);
  EXPECT_EQ(found->descriptor.joint_damping, 0.03);
  EXPECT_EQ(found->descriptor.joint_friction, 0.004);
  EXPECT_EQ(found->descriptor.joint_resolution, 2e-3);
  EXPECT_EQ(found->descriptor.frozen, milliseconds(50));
  EXPECT_EQ(found->descriptor.finger_command, FingerCommand::kCurlLimit);
  EXPECT_EQ(found->descriptor.limit_rate, 50.0);
  EXPECT_EQ(found->descriptor.limit_delay, milliseconds(7));
  EXPECT_EQ(found->descriptor.max_limit_stiffness, 3.0);
  EXPECT_EQ(found->descriptor.undriven_joints, descriptor.undriven_joints);
  EXPECT_EQ(found->descriptor.tool_command, ToolCommand::kHalfSpaces);
  EXPECT_EQ(found->descriptor.tool_rate, 2000.0);
  EXPECT_EQ(found->descriptor.tool_delay, milliseconds(2));
  EXPECT_EQ(found->descriptor.joint_upper, descriptor.joint_upper);
  EXPECT_EQ(found->descriptor.update_rate, 1000.0);
}

TEST(GloveInfo, IsHeardBetweenTwoCallsOfASearch) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  LcmGloveHost host(bus, simulated_glove_descriptor(), {.device = 3});
  GloveSearch search(bus);
  host.publish({});  // an announcement; the next one is due 200 ms later
  EXPECT_FALSE(search.wait_for(4, milliseconds(100)).has_value());
  EXPECT_TRUE(search.wait_for(3, milliseconds(0)).has_value());
}

TEST(GloveInfo, ASearchTellsWhyAGloveIsNotFound) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  GloveSearch search(bus);
  EXPECT_THAT(search.troubles(), testing::IsEmpty());
  bus->publish("GLOVE_STATE", encoded(good_state(1)));
  Bytes of_another_version = encode(GloveInfo{1, 1, hands::HandSide::kRight, simulated_glove_descriptor()});
  of_another_version[11] ^= 1U;  // the version follows the eight bytes of the type
  bus->publish("GLOVE_INFO", of_another_version);
  DeviceDescriptor impossible = simulated_glove_descriptor();
  impossible.max_force = kNan;
  bus->publish("GLOVE_INFO", encode(GloveInfo{1, 1, hands::HandSide::kRight, impossible}));
  impossible.max_force = -1.0;  // the first one of a kind is told
  bus->publish("GLOVE_INFO", encode(GloveInfo{1, 1, hands::HandSide::kRight, impossible}));
  EXPECT_FALSE(search.wait_for(1, milliseconds(200)).has_value());
  EXPECT_THAT(search.troubles(),
              testing::UnorderedElementsAre(
                  testing::MatchesRegex("announcements on GLOVE_INFO are refused: they have another "
                                        "version of the type: version is [0-9]+, not [0-9]+"),
                  "announcements on GLOVE_INFO are refused: a number is out of its range: max_force is nan",
                  "glove 1 sends states, but no announcement on GLOVE_INFO that can be used"));
  LcmGloveHost host(bus, simulated_glove_descriptor());
  host.publish({});
  ASSERT_TRUE(search.wait_for(1, std::chrono::seconds(10)).has_value());
  EXPECT_THAT(search.troubles(), testing::SizeIs(2)) << "the refusals";
}

}  // namespace
}  // namespace glissade::devices
