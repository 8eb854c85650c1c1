#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/simulated_glove.h>

#include "expect_bad_input.h"

namespace glissade::devices {
namespace {

void expect_refused(const DeviceDescriptor& descriptor, const std::string& field) {
  test_support::expect_bad_input([&] { validate(descriptor); }, {field});
}

TEST(GloveJoints, HaveDistinctNames) {
  EXPECT_EQ(std::set(hands::kJointNames.begin(), hands::kJointNames.end()).size(), 22U);
  EXPECT_EQ(hands::kJointNames[18], "little_ring_abduction");
}

TEST(DeviceDescriptor, DescriptorOfTheSimulatedGloveIsValid) {
  EXPECT_NO_THROW(validate(simulated_glove_descriptor()));
}

TEST(DeviceDescriptor, ComplaintsNameTheField) {
  DeviceDescriptor descriptor = simulated_glove_descriptor();
  descriptor.max_torque = std::numeric_limits<double>::quiet_NaN();
  expect_refused(descriptor, "max_torque");

  descriptor = simulated_glove_descriptor();
  descriptor.max_force = -1.0;
  expect_refused(descriptor, "max_force");

  descriptor = simulated_glove_descriptor();
  descriptor.update_rate = 0.0;
  expect_refused(descriptor, "update_rate");

  descriptor = simulated_glove_descriptor();
  descriptor.joint_upper[4] = descriptor.joint_lower[4];
  expect_refused(descriptor, "index_mcp");
}

}  // namespace
}  // namespace glissade::devices
