/// The forces of fingertips, for contacts made by hand.

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::haptics {
namespace {

constexpr std::size_t kIndexFinger = 1;
constexpr std::size_t kIndexPip = 5;
constexpr std::size_t kIndexDip = 6;

/// A hand stopped at angles of zero by these contacts, whose wearer closes the last two joints of the index finger.
std::array<double, kFingers> forces_with(const std::vector<FingerRow>& rows, double pip_rad, double dip_rad) {
  HandAnswer hand;
  for (const FingerRow& row : rows)
    hand.row_array[static_cast<std::size_t>(hand.row_count++)] = row;
  hands::JointValues targets{};
  targets[kIndexPip] = pip_rad;
  targets[kIndexDip] = dip_rad;
  return FingertipForces(finger_hand(grasping::make_hand()), devices::simulated_glove_descriptor())
      .update(targets, hand);
}

/// A contact that closes by so many metres a radian.
FingerRow row_with(double by_pip, double by_dip) {
  FingerRow row;
  row.rates[kIndexPip] = -by_pip;
  row.rates[kIndexDip] = -by_dip;
  return row;
}

double stiffness() {
  return finger_stiffness(devices::simulated_glove_descriptor(), kTickPeriod, std::chrono::nanoseconds(0));
}

TEST(FingertipForces, AreJointTorqueOverArm) {
  constexpr double kArm_m = 0.02;
  constexpr double kDeeper_rad = 5e-3;
  const std::array<double, kFingers> forces = forces_with({row_with(0.0, kArm_m)}, 0.0, kDeeper_rad);
  EXPECT_NEAR(forces[kIndexFinger], stiffness() * kDeeper_rad / kArm_m, 1e-9);
  EXPECT_EQ(forces[0], 0.0);
}

TEST(FingertipForces, AreZeroForContactsOfInnerSegments) {
  const std::array<double, kFingers> forces = forces_with({row_with(0.02, 0.0)}, 5e-3, 0.0);
  EXPECT_EQ(forces[kIndexFinger], 0.0);
}

// The middle segment bears its part of the torque of the joint that turns both.
TEST(FingertipForces, ShareTheTorqueWithContactsOfInnerSegments) {
  constexpr double kArm_m = 0.02;
  constexpr double kDeeper_rad = 5e-3;
  const std::vector<FingerRow> rows{row_with(0.015, 0.0), row_with(0.04, kArm_m)};
  const double torque = stiffness() * kDeeper_rad;  // at each of the two joints
  const double tip = torque / kArm_m;               // all of the last joint's torque
  const double left = torque - tip * 0.04;          // of the other's: negative, so the middle segment bears nothing
  ASSERT_LT(left, 0.0);
  const double alone = torque * (0.04 + kArm_m) / (0.04 * 0.04 + kArm_m * kArm_m);  // nearest to both torques
  EXPECT_NEAR(forces_with(rows, kDeeper_rad, kDeeper_rad)[kIndexFinger], alone, 1e-9);
  const double stronger = 0.5 * kDeeper_rad;
  EXPECT_NEAR(forces_with({row_with(0.015, 0.0), row_with(0.005, kArm_m)}, kDeeper_rad, stronger)[kIndexFinger],
              stiffness() * stronger / kArm_m, 1e-6)
      << "both torques can be met";
}

}  // namespace
}  // namespace glissade::haptics
