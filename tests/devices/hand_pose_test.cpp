/// Poses of a tracker that join the states of a glove which measures the fingers only.

#include <memory>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/lcmtypes/hand_pose_t.hpp>
#include <glissade/realtime/clock.h>

#include "glove_link_fixture.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::int64_t kHand = 7;

hand_pose_t good_pose(std::int64_t sequence) {
  hand_pose_t message{};
  message.version = hand_pose_t::VERSION;
  message.valid = 1;
  message.device = kHand;
  message.session = 5;
  message.sequence = sequence;
  message.time_ns = 1000 * sequence;
  message.orientation_WT_wxyz[0] = 1.0;
  return message;
}

TrackedPose pose_at(double x, std::int64_t sequence, nanoseconds time) {
  TrackedPose pose{.sequence = sequence, .time = time};
  pose.X_WT.translation().x() = x;
  return pose;
}

class HandPoseLink : public testing::Test {
 protected:
  /// Sends a pose and waits until it has been received.
  void send(const TrackedPose& pose) {
    const std::uint64_t before = source.statistics().accepted;
    tracker.publish(pose);
    ASSERT_TRUE(eventually([&] { return source.statistics().accepted == before + 1; }));
  }
  LinkStatistics after(const hand_pose_t& message) {
    const LinkStatistics before = source.statistics();
    bus->publish("HAND_POSE", encoded(message));
    EXPECT_TRUE(eventually([&] {
      const LinkStatistics now = source.statistics();
      return now.accepted + now.rejected() == before.accepted + before.rejected() + 1;
    }));
    return source.statistics();
  }
  GloveState joined() {
    GloveState state;
    state.time = clock.now();
    EXPECT_TRUE(source.join(state));
    return state;
  }

  realtime::SteadyClock clock;
  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  HandPoseSource source{bus, {.device = kHand}};
  HandPosePublisher tracker{bus, kHand};
};

TEST_F(HandPoseLink, HasNoPoseBeforeTheFirst) {
  GloveState state;
  EXPECT_FALSE(source.join(state));
  EXPECT_FALSE(source.newest());
}

TEST_F(HandPoseLink, GivesTheNewestPoseWithItsVelocities) {
  TrackedPose pose = pose_at(0.3, 1, clock.now());
  pose.X_WT.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.has_velocity = true;
  pose.v_WT = {1.0, 2.0, 3.0};
  pose.w_WT = {0.1, 0.2, 0.3};
  send(pose);
  const GloveState state = joined();
  EXPECT_TRUE(state.X_WH.isApprox(pose.X_WT));
  EXPECT_EQ(state.v_WH, pose.v_WT);
  EXPECT_EQ(state.w_WH, pose.w_WT);
}

TEST_F(HandPoseLink, FindsVelocitiesThatTheTrackerDoesNotMeasure) {
  const nanoseconds start = clock.now();
  TrackedPose later = pose_at(0.302, 2, start + milliseconds(10));
  later.X_WT.linear() = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY()).toRotationMatrix();
  send(pose_at(0.3, 1, start));
  send(later);  // at once: the clock of the sender counts
  const GloveState state = joined();
  EXPECT_NEAR(state.v_WH.x(), 0.2, 1e-3);
  EXPECT_NEAR(state.w_WH.y(), 1.0, 1e-2);
}

/// The age of a state is that of its older half.
TEST_F(HandPoseLink, MakesAStateAsOldAsItsPose) {
  const nanoseconds sent = clock.now();
  send(pose_at(0.3, 1, sent));
  std::this_thread::sleep_for(milliseconds(30));
  const GloveState state = joined();
  EXPECT_GE(clock.now() - state.time, milliseconds(29));
  EXPECT_GE(state.time, sent);
}

TEST_F(HandPoseLink, KnowsClocksOfOtherMachines) {
  for (const nanoseconds clock_of_sender : {nanoseconds(17), std::chrono::nanoseconds(std::chrono::hours(1000))}) {
    HandPoseSource other(bus, {.device = kHand});
    HandPosePublisher sender(bus, kHand);
    sender.publish(pose_at(0.0, 1, clock_of_sender));
    ASSERT_TRUE(eventually([&] { return other.newest().has_value(); }));
    EXPECT_LT(std::chrono::abs(clock.now() - *other.newest()), milliseconds(100));
  }
}

TEST_F(HandPoseLink, NeverGoesBackInTime) {
  const nanoseconds start = clock.now();
  send(pose_at(0.0, 1, start - milliseconds(50)));  // counts as sent now
  const GloveState first = joined();
  send(pose_at(0.1, 2, start));  // a faster message: the first one was older than it seemed
  EXPECT_GE(joined().time, first.time);
}

TEST_F(HandPoseLink, KeepsTheOldPoseWhileTheTrackerDoesNotSeeTheHand) {
  send(pose_at(0.3, 1, clock.now()));
  const GloveState before = joined();
  TrackedPose lost = pose_at(9.0, 2, clock.now());
  lost.is_valid = false;
  send(lost);
  const GloveState state = joined();
  EXPECT_EQ(state.X_WH.translation().x(), 0.3);
  EXPECT_EQ(state.time, before.time) << "it grows older";
}

TEST_F(HandPoseLink, RefusesWrongMessages) {
  EXPECT_EQ(after(good_pose(1)).accepted, 1U);
  hand_pose_t message = good_pose(2);
  message.device = kHand + 1;
  EXPECT_EQ(after(message).other_receiver, 1U);
  message = good_pose(3);
  message.session = 6;
  EXPECT_EQ(after(message).other_sender, 1U);
  message = good_pose(4);
  message.position_WT_m[1] = kNan;
  EXPECT_EQ(after(message).first_not_finite.name, "position_WT_m");
  message = good_pose(5);
  message.orientation_WT_wxyz[1] = 1.0;
  EXPECT_EQ(after(message).first_out_of_range.name, "orientation_WT_wxyz");
  message = good_pose(6);
  message.v_WT_m_per_s[0] = kNan;
  EXPECT_EQ(after(message).accepted, 2U) << "the tracker says that it measures no velocities";
  EXPECT_EQ(after(good_pose(6)).out_of_sequence, 1U);
}

TEST(HandPoseSource, RefusesARateThatIsNone) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  EXPECT_THROW(HandPoseSource(bus, {.rate_Hz = 0.0}), std::invalid_argument);
  EXPECT_THROW(HandPoseSource(nullptr, {}), std::invalid_argument);
  EXPECT_THROW(HandPosePublisher(nullptr, kHand), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::devices
