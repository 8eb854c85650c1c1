#include <limits>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/glove_types.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {
namespace {

std::string complaint(const DeviceDescriptor& descriptor) {
  try {
    validate(descriptor);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(GloveJoints, HaveDistinctNames) {
  EXPECT_EQ(std::set(kGloveJointNames.begin(), kGloveJointNames.end()).size(), 22U);
  EXPECT_EQ(kGloveJointNames[18], "little_ring_abduction");
}

TEST(DeviceDescriptor, TheSimulatedGlovesIsValid) {
  EXPECT_EQ(complaint(simulated_glove_descriptor()), "");
}

TEST(DeviceDescriptor, ComplaintsNameTheField) {
  DeviceDescriptor descriptor = simulated_glove_descriptor();
  descriptor.max_torque = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(descriptor), testing::HasSubstr("max_torque"));

  descriptor = simulated_glove_descriptor();
  descriptor.max_force = -1.0;
  EXPECT_THAT(complaint(descriptor), testing::HasSubstr("max_force"));

  descriptor = simulated_glove_descriptor();
  descriptor.update_rate = 0.0;
  EXPECT_THAT(complaint(descriptor), testing::HasSubstr("update_rate"));

  descriptor = simulated_glove_descriptor();
  descriptor.joint_upper[5] = descriptor.joint_lower[5];
  EXPECT_THAT(complaint(descriptor), testing::HasSubstr("index_pip"));
}

}  // namespace
}  // namespace glissade::devices
