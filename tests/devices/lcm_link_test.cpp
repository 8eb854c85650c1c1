#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/haptic_state_t.hpp>

#include "glove_link_fixture.h"
#include "lcm/glove_messages.h"
#include "lcm/haptic_state_message.h"
#include "safe_command.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST_F(LcmLink, StatesArriveWhole) {
  LcmGloveHost host(bus, descriptor);
  GloveState sent;
  sent.sequence = 42;
  sent.time = nanoseconds(123456789012);
  sent.X_WH = Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(2.0, Vector3d(1, 2, 3).normalized());
  sent.v_WH = Vector3d(1, 2, 3);
  sent.w_WH = Vector3d(-4, 5, -6);
  for (std::size_t i = 0; i < hands::kJoints; ++i)
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

/// Both ends on one bus. The server answers each state that it reads by `wanted`; both ends have their envelope.
class BothEnds : public testing::Test {
 protected:
  /// One period of the glove's device, in real time.
  SafeCommand period() {
    std::this_thread::sleep_for(milliseconds(1));
    state.time = clock.now();
    ++state.sequence;
    host.publish(state);
    if (server_answers && glove.read(seen)) {
      GloveCommand command = wanted;
      command.sequence = ++sequence;
      command.state_sequence = seen.sequence;
      command.state_time = seen.time;
      command.time = clock.now();
      glove.command(envelope.limit(command, seen, clock.now()));
    }
    return host.newest_command(state);
  }

  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  const DeviceDescriptor descriptor = simulated_glove_descriptor();
  /// Patient, because a busy machine may stop any thread for tens of milliseconds.
  LcmGloveHost host{bus, descriptor, {.patience_periods = 200.0}};
  LcmGlove glove{bus, descriptor};
  SafetyEnvelope envelope{descriptor, 200.0};
  realtime::SteadyClock clock;
  GloveState state;
  GloveState seen;
  GloveCommand wanted;
  std::int64_t sequence = 0;
  bool server_answers = true;
};

TEST_F(BothEnds, CommandsReachTheGloveWithinItsLimits) {
  wanted.f_H_W = Vector3d(300, 0, 400);
  wanted.t_H_W = Vector3d(0.1, 0.2, 0.3);
  wanted.joint_torques[21] = -0.25;
  GloveCommand newest;
  EXPECT_TRUE(eventually([&] {
    newest = period().values();
    return newest.f_H_W.isApprox(Vector3d(12, 0, 16), 1e-12) && newest.t_H_W.isApprox(wanted.t_H_W, 1e-12) &&
           newest.joint_torques == wanted.joint_torques;
  })) << newest.f_H_W.transpose();
  EXPECT_GT(newest.sequence, 0);
  EXPECT_GT(newest.state_sequence, 0);
  EXPECT_GT(newest.time, nanoseconds(0));
}

TEST_F(BothEnds, GloveAt10kHzKeepsForceOfAServerAt1kHz) {
  DeviceDescriptor fast = descriptor;
  fast.update_rate = 10'000.0;
  LcmGloveHost impatient(bus, fast, {.device = 2});
  LcmGlove server(bus, fast, {.device = 2});
  wanted.f_H_W.x() = 15.0;
  EXPECT_TRUE(eventually([&] {
    std::this_thread::sleep_for(milliseconds(1));
    state.time = clock.now();
    ++state.sequence;
    impatient.publish(state);
    if (server.read(seen)) {
      wanted.sequence = wanted.state_sequence = seen.sequence;
      wanted.state_time = seen.time;
      server.command(envelope.limit(wanted, seen, clock.now()));
    }
    return impatient.newest_command(state).values().f_H_W.x() > 1.0;
  }));
}

TEST_F(BothEnds, AServerThatFallsSilentLosesItsForceByARamp) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_TRUE(eventually([&] { return period().values().f_H_W.x() == 15.0; }));
  server_answers = false;
  double last = 15.0;
  EXPECT_TRUE(eventually([&] {
    const SafeCommand now = period();
    const double force = now.values().f_H_W.x();
    EXPECT_LE(last - force, 2.0 * 20.0 / 7.0 * (1.0 + 1e-9)) << "two periods count at most";
    last = force;
    return force == 0.0 && now.reasons().is_command_old;
  }));
}

TEST_F(BothEnds, ASecondServerIsRefusedAndToldSo) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_TRUE(eventually([&] { return period().values().f_H_W.x() == 15.0; }));
  LcmGlove second(bus, descriptor);
  GloveCommand other;
  GloveState state_of_second;
  ASSERT_TRUE(eventually([&] {
    period();
    ++other.sequence;
    second.command(test_support::safe_command(other, descriptor));
    second.read(state_of_second);
    return host.statistics().other_sender > 20 && state_of_second.obeys_another;
  }));
  EXPECT_FALSE(seen.obeys_another) << "the first server keeps the glove";
  EXPECT_EQ(period().values().f_H_W.x(), 15.0);
}

TEST_F(BothEnds, ASecondGloveOfTheSameNumberIsNotListenedTo) {
  ASSERT_TRUE(eventually([&] { return period().values().sequence > 0; }));
  LcmGloveHost twin(bus, descriptor);
  GloveState elsewhere = state;
  elsewhere.X_WH.translation().x() = 0.5;
  ASSERT_TRUE(eventually([&] {
    ++elsewhere.sequence;
    twin.publish(elsewhere);
    period();
    EXPECT_EQ(seen.X_WH.translation().x(), 0.0);
    return glove.statistics().other_sender > 20;
  }));
  EXPECT_TRUE(eventually([&] { return twin.statistics().other_receiver > 0; })) << "commands name the glove's session";
  EXPECT_TRUE(eventually([&] {
    twin.publish(elsewhere);
    host.publish(state);
    return twin.shares_number() && host.shares_number();
  })) << "each hears the announcements of the other";
}

TEST_F(BothEnds, GlovesWithDifferentNumbersAreIndependent) {
  LcmGloveHost left(bus, descriptor, {.device = 2, .side = hands::HandSide::kLeft});
  LcmGlove left_glove(bus, descriptor, {.device = 2});
  GloveState left_state;
  left_state.X_WH.translation().x() = 0.5;
  GloveState seen_left;
  ASSERT_TRUE(eventually([&] {
    ++left_state.sequence;
    left.publish(left_state);
    period();
    return left_glove.read(seen_left) && sequence > 20;
  }));
  EXPECT_EQ(seen_left.X_WH.translation().x(), 0.5);
  EXPECT_EQ(seen.X_WH.translation().x(), 0.0);
  EXPECT_EQ(left.statistics().accepted, 0U);
  EXPECT_FALSE(left.shares_number());
  EXPECT_GT(left.statistics().other_receiver, 0U);
}

// A send thread that comes late sends what has waited.
TEST_F(BothEnds, EveryCommandIsSentInItsOrder) {
  ASSERT_TRUE(eventually([&] { return period().values().sequence > 0; }));
  const std::uint64_t accepted = host.statistics().accepted;
  constexpr std::uint64_t kAtOnce = 50;
  server_answers = false;
  for (std::uint64_t i = 0; i < kAtOnce; ++i) {
    wanted.sequence = ++sequence;
    glove.command(test_support::limited(envelope, wanted, seen));
  }
  EXPECT_TRUE(eventually([&] { return host.statistics().accepted >= accepted + kAtOnce; }));
  EXPECT_EQ(host.statistics().lost, 0U);
  EXPECT_EQ(glove.commands_dropped(), 0U);
}

// Before the first command is limited, its server is told nothing: that no command has come would look like an old one.
TEST_F(BothEnds, TheGloveTellsAServerOnlyOfItsOwnCommands) {
  const auto publish = [&] {
    state.time = clock.now();
    ++state.sequence;
    host.publish(state);
  };
  host.newest_command(state);  // of no server
  ASSERT_TRUE(eventually([&] {
    publish();
    return glove.read(seen);
  }));
  glove.command(test_support::limited(envelope, wanted, seen));
  ASSERT_TRUE(eventually([&] { return host.statistics().accepted > 0; }));
  publish();
  ASSERT_TRUE(eventually([&] { return glove.read(seen) && seen.sequence == state.sequence; }));
  EXPECT_FALSE(seen.limits.any());
  EXPECT_EQ(seen.command_age, nanoseconds(0));
  host.newest_command(state);
  publish();
  ASSERT_TRUE(eventually([&] { return glove.read(seen) && seen.sequence == state.sequence; }));
  EXPECT_GT(seen.command_age, nanoseconds(0));
}

// The whole loop: a simulated glove is pushed off by a server that answers every state.
TEST_F(BothEnds, ASimulatedGloveYieldsToTheServer) {
  wanted.f_H_W = Vector3d(4, 0, 0);
  SimulatedGlove simulated(geometry::PoseTrajectory({{nanoseconds(0), Eigen::Isometry3d::Identity()}}));
  SafeCommand newest;
  EXPECT_TRUE(eventually([&] {
    const GloveState moved = simulated.step(milliseconds(1), newest);
    state.X_WH = moved.X_WH;
    state.v_WH = moved.v_WH;
    newest = period();
    return std::abs(moved.X_WH.translation().x() - 4.0 / SimulatedGloveParameters{}.wearer_stiffness) < 1e-4;
  }));
  EXPECT_EQ(glove.statistics().rejected(), 0U);
}

TEST(LcmGlove, SendsZeroForceOnDestruction) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  const DeviceDescriptor descriptor = simulated_glove_descriptor();
  std::atomic<double> last_force{-1.0};
  const auto subscription = bus->subscribe("GLOVE_COMMAND", [&](std::span<const std::uint8_t> bytes) {
    CommandHeader header;
    GloveCommand command;
    ASSERT_EQ(decode(bytes, header, command), MessageError::kNone);
    last_force = command.f_H_W.x();
  });
  {
    LcmGlove glove(bus, descriptor);
    GloveCommand sent;
    sent.sequence = 1;
    sent.f_H_W = Vector3d(1, 0, 0);
    glove.command(test_support::safe_command(sent, descriptor));
    ASSERT_TRUE(eventually([&] { return last_force == 1.0; })) << last_force;
  }
  EXPECT_TRUE(eventually([&] { return last_force == 0.0; }));
}

TEST(LcmGlove, RefusesABadDescriptor) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  EXPECT_THROW(LcmGlove(bus, {.update_rate = 0.0}), std::invalid_argument);
}

/// A good command for this glove, which must have published once.
class CommandsToAGlove : public testing::Test {
 protected:
  CommandsToAGlove() {
    EXPECT_TRUE(eventually([&] {
      host.publish(GloveState{});
      return session != 0;
    }));
    good.version = glove_command_t::VERSION;
    good.device = kDefaultDevice;
    good.glove_session = session;
    good.session = 5;
    good.sequence = 1;
  }

  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  std::atomic<std::int64_t> session{0};
  LcmGloveHost host{bus, simulated_glove_descriptor()};
  std::unique_ptr<LcmBus::Subscription> states =
      bus->subscribe("GLOVE_STATE", [this](std::span<const std::uint8_t> bytes) {
        glove_state_t message{};
        ASSERT_GT(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
        session = message.session;
      });
  glove_command_t good{};
};

TEST_F(CommandsToAGlove, GloveReportsLimitReasonsAndCommandAge) {
  LcmGlove server(bus, simulated_glove_descriptor());
  GloveState measured;
  GloveState told;
  const SafeCommand of_long_ago;  // answers the state of time zero
  const auto period = [&] {
    server.command(of_long_ago);
    measured.time = nanoseconds(std::chrono::steady_clock::now().time_since_epoch());
    ++measured.sequence;
    host.newest_command(measured);
    host.publish(measured);
    return server.read(told) && told.command_age > nanoseconds(0);
  };
  ASSERT_TRUE(eventually(period));
  EXPECT_TRUE(told.limits.is_command_old);
  EXPECT_GT(told.command_age, milliseconds(10));
}

TEST_F(CommandsToAGlove, SpoiltOnesAreRefused) {
  const auto send_spoilt = [&](const std::function<void(glove_command_t&)>& spoil) {
    glove_command_t message = good;
    spoil(message);
    bus->publish("GLOVE_COMMAND", encoded(message));
  };
  send_spoilt([](glove_command_t& m) { m.force_H_W_N[0] = kNan; });
  send_spoilt([](glove_command_t& m) { m.force_H_W_N[0] = 1e7; });
  send_spoilt([](glove_command_t& m) { m.joint_torques_Nm[21] = kNan; });
  send_spoilt([](glove_command_t& m) { m.state_time_ns = -1; });
  send_spoilt([](glove_command_t& m) { ++m.version; });
  send_spoilt([](glove_command_t& m) { ++m.glove_session; });
  bus->publish("GLOVE_COMMAND", Bytes(7));
  ASSERT_TRUE(eventually([&] { return host.statistics().rejected() == 7; }));
  EXPECT_EQ(host.statistics().not_finite, 2U);
  EXPECT_EQ(host.statistics().out_of_range, 2U);
  EXPECT_EQ(host.statistics().wrong_version, 1U);
  EXPECT_EQ(host.statistics().other_receiver, 1U);
  EXPECT_EQ(host.statistics().wrong_size, 1U);
  bus->publish("GLOVE_COMMAND", encoded(good));
  EXPECT_TRUE(eventually([&] { return host.statistics().accepted == 1; }));
}

TEST_F(CommandsToAGlove, AMillionNewtonsBecomeASoftStartWithinTheLimits) {
  realtime::SteadyClock clock;
  GloveState state;
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    std::this_thread::sleep_for(milliseconds(1));
    state.time = clock.now();
    ++state.sequence;
    ++good.sequence;
    good.state_time_ns = state.time.count();
    good.force_H_W_N[0] = 1e6;
    bus->publish("GLOVE_COMMAND", encoded(good));
    const double force = host.newest_command(state).values().f_H_W.norm();
    EXPECT_LE(force, 20.0);
    EXPECT_LE(force - last, 2.0 * 20.0 / 200.0 * (1.0 + 1e-9)) << "at most two periods of the soft return";
    last = force;
  }
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
      state.contact_set_age = milliseconds(i);
      state.is_contact_set_late = true;
      state.parts[0].X_WV.translation() = Vector3d(4, 5, 6);
      state.hands[0].force_W = Vector3d(7, 8, 9);
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
    EXPECT_EQ(message.contact_set_age_ns, i * 1000000LL);
  }
  const haptic_state_t& last = received.back();
  EXPECT_EQ(last.parts[0].position_WV_m[2], 6.0);
  EXPECT_EQ(last.parts[0].orientation_WV_wxyz[0], 1.0);
  EXPECT_EQ(last.hands[0].force_W_N[2], 9.0);
  EXPECT_EQ(last.flags, haptic_state_t::FLAG_CONTACT_SET_LATE);
}

TEST(HapticStatePublisher, TellsAListenerOfEveryTickInOrderThoughItFailsOnce) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  std::vector<std::int64_t> heard;
  {
    HapticStatePublisher publisher(bus, [&](const HapticState& state) {
      heard.push_back(state.sequence);
      if (state.sequence == 3) throw std::runtime_error("a viewer that fails");
    });
    for (int i = 0; i < 100; ++i) {
      HapticState state;
      state.sequence = i;
      publisher.push(state);
    }
  }
  ASSERT_EQ(heard.size(), 100U);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(heard[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace glissade::devices
