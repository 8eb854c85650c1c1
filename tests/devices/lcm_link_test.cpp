#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/haptic_state_publisher.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>
#include <glissade/lcmtypes/haptic_state_t.hpp>

#include "eventually.h"

namespace glissade::devices {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Message>
Bytes encoded(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

glove_state_t good_state(std::int64_t sequence) {
  glove_state_t message{};
  message.sequence = sequence;
  message.orientation_WH_wxyz[0] = 1.0;
  return message;
}

class LcmLink : public testing::Test {
 protected:
  /// Sends `bytes` as a glove would and returns what the link makes of them.
  LinkStatistics after(const Bytes& bytes) {
    const LinkStatistics before = glove.statistics();
    bus->publish("GLOVE_STATE", bytes);
    EXPECT_TRUE(eventually([&] {
      const LinkStatistics now = glove.statistics();
      return now.accepted + now.rejected() == before.accepted + before.rejected() + 1;
    }));
    return glove.statistics();
  }

  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  LcmGlove glove{bus, simulated_glove_descriptor()};
};

TEST_F(LcmLink, StatesArriveWhole) {
  LcmGloveHost host(bus);
  GloveState sent;
  sent.sequence = 42;
  sent.time = nanoseconds(123456789012);
  sent.X_WH = Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(2.0, Vector3d(1, 2, 3).normalized());
  sent.v_WH = Vector3d(1, 2, 3);
  sent.w_WH = Vector3d(-4, 5, -6);
  for (std::size_t i = 0; i < kGloveJoints; ++i)
    sent.joint_angles[i] = 0.01 * static_cast<double>(i);

  GloveState received;
  EXPECT_FALSE(glove.read(received));
  EXPECT_TRUE(host.publish(sent));
  ASSERT_TRUE(eventually([&] { return glove.read(received); }));
  EXPECT_EQ(received.sequence, sent.sequence);
  EXPECT_EQ(received.time, sent.time);
  EXPECT_TRUE(received.X_WH.isApprox(sent.X_WH, 1e-14));
  EXPECT_EQ(received.v_WH, sent.v_WH);
  EXPECT_EQ(received.w_WH, sent.w_WH);
  EXPECT_EQ(received.joint_angles, sent.joint_angles);
  EXPECT_TRUE(glove.read(received)) << "the newest state can be read again";
}

TEST_F(LcmLink, CommandsReachTheGloveWithinItsLimits) {
  LcmGloveHost host(bus);
  EXPECT_EQ(host.newest_command().sequence, 0);
  GloveCommand sent;
  sent.sequence = 5;
  sent.state_sequence = 4;
  sent.time = nanoseconds(99);
  sent.f_H_W = Vector3d(300, 0, 400);
  sent.t_H_W = Vector3d(0.1, 0.2, 0.3);
  sent.joint_torques[21] = -0.25;
  glove.command(sent);
  ASSERT_TRUE(eventually([&] { return host.statistics().accepted == 1; }));
  const GloveCommand received = host.newest_command();
  EXPECT_EQ(received.sequence, 5);
  EXPECT_EQ(received.state_sequence, 4);
  EXPECT_EQ(received.time, nanoseconds(99));
  EXPECT_TRUE(received.f_H_W.isApprox(Vector3d(12, 0, 16), 1e-12));
  EXPECT_EQ(received.t_H_W, sent.t_H_W);
  EXPECT_EQ(received.joint_torques, sent.joint_torques);
}

TEST_F(LcmLink, AnOldCommandIsNotObeyed) {
  LcmGloveHost host(bus, {.command_timeout = milliseconds(20)});
  GloveCommand sent;
  sent.sequence = 1;
  sent.f_H_W = Vector3d(1, 0, 0);
  sent.joint_torques.fill(0.1);
  glove.command(sent);
  ASSERT_TRUE(eventually([&] { return host.statistics().accepted == 1; }));
  ASSERT_TRUE(eventually([&] { return host.newest_command().f_H_W.isZero(0.0); }));
  EXPECT_EQ(host.newest_command().sequence, 1);
  EXPECT_EQ(host.newest_command().joint_torques, JointValues{});
}

TEST(LcmGlove, LeavesTheGloveWithoutForce) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  LcmGloveHost host(bus, {.command_timeout = std::chrono::hours(1)});
  {
    LcmGlove glove(bus, simulated_glove_descriptor());
    GloveCommand sent;
    sent.sequence = 1;
    sent.f_H_W = Vector3d(1, 0, 0);
    glove.command(sent);
    ASSERT_TRUE(eventually([&] { return host.newest_command().f_H_W.x() == 1.0; }));
  }
  EXPECT_TRUE(eventually([&] { return host.newest_command().f_H_W.isZero(0.0); }));
}

TEST(LcmGlove, RefusesABadDescriptor) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  EXPECT_THROW(LcmGlove(bus, DeviceDescriptor{}), std::invalid_argument);
}

TEST_F(LcmLink, RefusesMessagesOfTheWrongSize) {
  const Bytes good = encoded(good_state(1));
  for (std::size_t size = 0; size < good.size(); size += 13) {
    EXPECT_EQ(after(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).accepted, 0U) << size;
  }
  Bytes longer = good;
  longer.push_back(0);
  const LinkStatistics statistics = after(longer);
  EXPECT_EQ(statistics.accepted, 0U);
  EXPECT_EQ(statistics.wrong_size, statistics.rejected());
}

TEST_F(LcmLink, RefusesAnotherTypeOfTheSameSize) {
  Bytes bytes = encoded(good_state(1));
  bytes[3] = static_cast<std::uint8_t>(bytes[3] ^ 1U);  // the first eight bytes tell the type
  EXPECT_EQ(after(bytes).undecodable, 1U);
}

TEST_F(LcmLink, RefusesNumbersThatAreNone) {
  const std::function<void(glove_state_t&)> spoilers[] = {[](glove_state_t& m) { m.position_WH_m[1] = kNan; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = kNan; },
                                                          [](glove_state_t& m) { m.v_WH_m_per_s[2] = -kInfinity; },
                                                          [](glove_state_t& m) { m.w_WH_rad_per_s[0] = kInfinity; },
                                                          [](glove_state_t& m) { m.joint_angles_rad[21] = kNan; }};
  std::uint64_t refused = 0;
  for (const auto& spoil : spoilers) {
    glove_state_t message = good_state(1);
    spoil(message);
    EXPECT_EQ(after(encoded(message)).not_finite, ++refused);
  }
  GloveState state;
  EXPECT_FALSE(glove.read(state));
}

TEST_F(LcmLink, RefusesNumbersBeyondSense) {
  const std::function<void(glove_state_t&)> spoilers[] = {[](glove_state_t& m) { m.sequence = -1; },
                                                          [](glove_state_t& m) { m.time_ns = -1; },
                                                          [](glove_state_t& m) { m.position_WH_m[2] = 1001.0; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = 0.0; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = 1.0011; },
                                                          [](glove_state_t& m) { m.v_WH_m_per_s[0] = -1001.0; },
                                                          [](glove_state_t& m) { m.w_WH_rad_per_s[1] = 1e5; },
                                                          [](glove_state_t& m) { m.joint_angles_rad[0] = 6.3; }};
  std::uint64_t refused = 0;
  for (const auto& spoil : spoilers) {
    glove_state_t message = good_state(1);
    spoil(message);
    EXPECT_EQ(after(encoded(message)).out_of_range, ++refused);
  }
}

TEST_F(LcmLink, NormalizesAQuaternionThatIsNearlyOne) {
  glove_state_t message = good_state(1);
  message.orientation_WH_wxyz[0] = 0.9995;
  EXPECT_EQ(after(encoded(message)).accepted, 1U);
  GloveState state;
  ASSERT_TRUE(glove.read(state));
  EXPECT_TRUE(state.X_WH.linear().isIdentity(1e-15));
}

TEST_F(LcmLink, SequencesMustRiseAndGapsAreCounted) {
  EXPECT_EQ(after(encoded(good_state(10))).accepted, 1U);
  EXPECT_EQ(after(encoded(good_state(10))).out_of_sequence, 1U);
  EXPECT_EQ(after(encoded(good_state(9))).out_of_sequence, 2U);
  EXPECT_EQ(after(encoded(good_state(11))).lost, 0U);
  EXPECT_EQ(after(encoded(good_state(15))).lost, 3U);
  GloveState state;
  ASSERT_TRUE(glove.read(state));
  EXPECT_EQ(state.sequence, 15);
}

TEST(LcmGloveHost, AcceptsARestartedServerAfterASilence) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  LcmGloveHost host(bus, {.restart_silence = milliseconds(30)});
  glove_command_t message{};
  message.sequence = std::numeric_limits<std::int64_t>::max();
  bus->publish("GLOVE_COMMAND", encoded(message));
  ASSERT_TRUE(eventually([&] { return host.statistics().accepted == 1; }));
  message.sequence = 0;
  std::this_thread::sleep_for(milliseconds(60));
  bus->publish("GLOVE_COMMAND", encoded(message));
  EXPECT_TRUE(eventually([&] { return host.statistics().accepted == 2; }));
  EXPECT_EQ(host.statistics().lost, 0U);
}

TEST(LcmGloveHost, RefusesSpoiltCommands) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  LcmGloveHost host(bus);
  glove_command_t message{};
  message.sequence = 1;
  message.force_H_W_N[0] = kNan;
  bus->publish("GLOVE_COMMAND", encoded(message));
  message.force_H_W_N[0] = 1e7;
  bus->publish("GLOVE_COMMAND", encoded(message));
  message.force_H_W_N[0] = 0.0;
  message.joint_torques_Nm[21] = kNan;
  bus->publish("GLOVE_COMMAND", encoded(message));
  bus->publish("GLOVE_COMMAND", Bytes(7));
  ASSERT_TRUE(eventually([&] { return host.statistics().rejected() == 4; }));
  EXPECT_EQ(host.statistics().not_finite, 2U);
  EXPECT_EQ(host.statistics().out_of_range, 1U);
  EXPECT_EQ(host.statistics().wrong_size, 1U);
}

TEST(HapticStatePublisher, PublishesEveryTickInOrder) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  std::mutex mutex;
  std::vector<haptic_state_t> received;
  const auto subscription = bus->subscribe("HAPTIC_STATE", [&](std::span<const std::uint8_t> bytes) {
    haptic_state_t message{};
    ASSERT_GT(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
    const std::lock_guard lock(mutex);
    received.push_back(message);
  });
  {
    HapticStatePublisher publisher(bus);
    for (int i = 0; i < 100; ++i) {
      HapticState state;
      state.sequence = i;
      state.X_WG.translation() = Vector3d(1, 2, 3);
      state.X_WV.translation() = Vector3d(4, 5, 6);
      state.force_on_hand_W = Vector3d(7, 8, 9);
      state.torque_on_hand_V_W = Vector3d(10, 11, 12);
      state.part_state = PartState::kSliding;
      state.contact_count = i;
      state.contact_set_age = milliseconds(i);
      state.is_in_contact = true;
      state.is_contact_set_late = true;
      EXPECT_TRUE(publisher.push(state));
    }
    EXPECT_EQ(publisher.dropped(), 0U);
  }
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return received.size() == 100;
  }));
  for (int i = 0; i < 100; ++i) {
    const haptic_state_t& message = received[static_cast<std::size_t>(i)];
    EXPECT_EQ(message.sequence, i);
    EXPECT_EQ(message.contact_count, i);
    EXPECT_EQ(message.contact_set_age_ns, i * 1000000LL);
  }
  const haptic_state_t& last = received.back();
  EXPECT_EQ(last.position_WG_m[2], 3.0);
  EXPECT_EQ(last.position_WV_m[2], 6.0);
  EXPECT_EQ(last.orientation_WV_wxyz[0], 1.0);
  EXPECT_EQ(last.force_on_hand_W_N[2], 9.0);
  EXPECT_EQ(last.torque_on_hand_V_W_Nm[2], 12.0);
  EXPECT_EQ(last.part_state, haptic_state_t::PART_SLIDING);
  EXPECT_EQ(last.flags, 1 + 4);  // FLAG_IN_CONTACT and FLAG_CONTACT_SET_LATE
}

// The whole loop: a simulated glove in a thread of its own, pushed off by a server that answers every state.
TEST_F(LcmLink, ASimulatedGloveYieldsToTheServer) {
  std::atomic<bool> done{false};
  std::atomic<double> hand_x{0.0};
  std::thread glove_thread([&] {
    LcmGloveHost host(bus);
    SimulatedGlove simulated(geometry::PoseTrajectory({{nanoseconds(0), Eigen::Isometry3d::Identity()}}));
    while (!done) {
      host.publish(simulated.step(milliseconds(1), host.newest_command()));
      hand_x = simulated.state().X_WH.translation().x();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  GloveState state;
  GloveCommand command;
  EXPECT_TRUE(eventually([&] {
    if (glove.read(state)) {
      ++command.sequence;
      command.state_sequence = state.sequence;
      command.f_H_W = Vector3d(4, 0, 0);
      glove.command(command);
    }
    return std::abs(hand_x - 4.0 / SimulatedGloveParameters{}.wearer_stiffness) < 1e-4;
  }));
  done = true;
  glove_thread.join();
  EXPECT_EQ(glove.statistics().rejected(), 0U);
}

}  // namespace
}  // namespace glissade::devices
