/// What leaves the glove's end of a link: states with the pose of a tracker and calibrated angles, commands in the
/// angles of the device, and limits that open when the tracker is lost.

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>

#include "eventually.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kFingerJoint = 4;

/// A glove that measures the fingers only, and reports half of each angle.
DeviceDescriptor finger_glove() {
  DeviceDescriptor descriptor;
  descriptor.name = "glove";
  descriptor.max_stiffness = 1000.0;
  descriptor.max_rotational_stiffness = 100.0;
  descriptor.max_joint_torque = 0.5;
  descriptor.finger_command = FingerCommand::kJointLimit;
  descriptor.limit_rate = 1000.0;
  descriptor.max_limit_stiffness = 2.0;
  descriptor.joint_lower[kFingerJoint] = -0.1;
  descriptor.joint_upper[kFingerJoint] = 0.8;
  descriptor.update_rate = 100.0;
  return descriptor;
}

Calibration doubling() {
  Calibration calibration{.user = "anna", .device = "glove", .side = hands::HandSide::kRight};
  calibration.joints[kFingerJoint] = JointCalibration{.gain = 2.0};
  calibration.X_TH.translation() = Eigen::Vector3d(0.0, 0.0, -0.04);
  return calibration;
}

/// Both ends of a link, and a tracker.
class PreparedGlove : public testing::Test {
 protected:
  explicit PreparedGlove(const LcmGloveHostOptions& options = {.side = hands::HandSide::kRight,
                                                               .calibration = doubling(),
                                                               .hand_pose = HandPoseOptions{.rate_Hz = 50.0}})
      : host(bus, finger_glove(), options) {}

  /// One period of the glove, whose finger stands at this reported angle. The tracker is at a height of 0.3 m.
  SafeCommand period(double reported, bool is_tracked = true) {
    std::this_thread::sleep_for(milliseconds(5));
    ++measured.sequence;
    measured.time = clock.now();
    measured.joint_angles[kFingerJoint] = reported;
    if (is_tracked) {
      TrackedPose pose{.sequence = measured.sequence, .time = measured.time};
      pose.X_WT.translation().z() = 0.3;
      tracker.publish(pose);
    }
    host.publish(measured);
    return host.newest_command(measured);
  }

  /// The server stops the finger at the angle 1 of the hand.
  void answer() {
    GloveState state;
    if (!server.read(state)) return;
    GloveCommand wanted{.sequence = ++commands, .state_sequence = state.sequence, .state_time = state.time};
    wanted.time = clock.now();
    wanted.joint_limits.joints[kFingerJoint] = {.upper = 1.0, .stiffness = 1.0, .max_torque = 0.5};
    const SafeCommand safe = envelope.limit(wanted, state, clock.now());
    has_old_state = safe.reasons().is_state_old;
    server.command(safe);
  }

  realtime::SteadyClock clock;
  std::chrono::nanoseconds start = clock.now();
  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  LcmGloveHost host;
  HandPosePublisher tracker{bus, kDefaultDevice};
  GloveSearch search{bus};
  LcmGlove server{bus, doubling().calibrated(finger_glove())};
  SafetyEnvelope envelope{doubling().calibrated(finger_glove())};
  GloveState measured;
  std::int64_t commands = 0;
  bool has_old_state = false;  ///< of the last answer
};

TEST_F(PreparedGlove, SendsNothingBeforeTheFirstPose) {
  for (int i = 0; i < 5; ++i)
    EXPECT_TRUE(period(0.3, false).values().is_at_rest());
  EXPECT_FALSE(search.wait_for(kDefaultDevice, milliseconds(20)));
}

TEST_F(PreparedGlove, SendsCalibratedAnglesAtTheTrackedPlace) {
  GloveState state;
  ASSERT_TRUE(eventually([&] {
    period(0.3);
    return server.read(state);
  }));
  EXPECT_NEAR(state.joint_angles[kFingerJoint], 0.6, 1e-12);
  EXPECT_NEAR(state.X_WH.translation().z(), 0.26, 1e-12) << "the hand is below the tracker";
}

TEST_F(PreparedGlove, AnnouncesThatItIsCalibratedAndTheSlowerRate) {
  std::optional<GloveInfo> info;
  ASSERT_TRUE(eventually([&] {
    period(0.3);
    info = search.wait_for(kDefaultDevice, milliseconds(0));
    return info.has_value();
  }));
  EXPECT_TRUE(info->is_calibrated);
  EXPECT_NEAR(info->descriptor.joint_upper[kFingerJoint], 1.6, 1e-12);
  EXPECT_EQ(info->descriptor.update_rate, 50.0);
}

TEST_F(PreparedGlove, HoldsLimitsInItsOwnAnglesAndOpensThemWhenTheTrackerIsLost) {
  JointLimit limit;
  ASSERT_TRUE(eventually([&] {
    const SafeCommand command = period(0.3);
    answer();
    limit = command.values().joint_limits.joints[kFingerJoint];
    return limit.max_torque > 0.45;
  }));
  EXPECT_NEAR(limit.upper, 0.5, 1e-9) << "1 rad of the hand";
  EXPECT_NEAR(limit.stiffness, 2.0, 1e-9) << "1 Nm per rad of the hand";

  double greatest_step = 0.0;
  ASSERT_TRUE(eventually([&] {
    const double before = limit.max_torque;
    limit = period(0.3, false).values().joint_limits.joints[kFingerJoint];  // the fingers are still measured
    answer();
    greatest_step = std::max(greatest_step, before - limit.max_torque);
    return limit.max_torque == 0.0;
  }));
  EXPECT_TRUE(has_old_state);
  EXPECT_LT(greatest_step, 0.4) << "it fades";

  ASSERT_TRUE(eventually([&] {
    limit = period(0.3).values().joint_limits.joints[kFingerJoint];
    answer();
    return limit.max_torque > 0.45;
  })) << "the limit comes back with the tracker";
}

// Else the hand would seem to go a whole way of the tracker in no time, and limits would open.
TEST_F(PreparedGlove, MovingHandIsPlausibleWhileItsFingersAreLate) {
  bool is_tracked = false;
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(milliseconds(5));
    TrackedPose pose{.sequence = i, .time = clock.now()};
    pose.X_WT.translation().x() = 1.0 * std::chrono::duration<double>(pose.time - start).count();
    tracker.publish(pose);
    if (i % 3 == 0) {
      ++measured.sequence;
      measured.time = clock.now();
      is_tracked = host.publish(measured) || is_tracked;
    }
    answer();
    EXPECT_FALSE(host.newest_command(measured).reasons().is_implausible) << i;
  }
  EXPECT_TRUE(is_tracked);
}

TEST(PreparedGloveOptions, RefuseGainsAndOffsetsThatAreNone) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  for (const JointCalibration& joint : {JointCalibration{.gain = -1.0}, JointCalibration{.gain = 1e3},
                                        JointCalibration{.gain = std::numeric_limits<double>::quiet_NaN()},
                                        JointCalibration{.offset = std::numeric_limits<double>::infinity()}}) {
    Calibration calibration = doubling();
    calibration.joints[kFingerJoint] = joint;
    EXPECT_THROW(LcmGloveHost(bus, finger_glove(), {.side = hands::HandSide::kRight, .calibration = calibration}),
                 std::invalid_argument);
  }
}

TEST(PreparedGloveOptions, DoNotLetATrackerPlaceAForce) {
  DeviceDescriptor arm = finger_glove();
  arm.max_force = 10.0;
  const auto bus = std::make_shared<LcmBus>("memq://");
  EXPECT_THROW(LcmGloveHost(bus, arm, {.hand_pose = HandPoseOptions{}}), std::invalid_argument);
}

TEST(PreparedGloveOptions, RefuseTheCalibrationOfAnotherSide) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  EXPECT_THROW(LcmGloveHost(bus, finger_glove(), {.side = hands::HandSide::kLeft, .calibration = doubling()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace glissade::devices
