// A glove whose driver is another thread than the haptic loop. All but the last test are on a simulated clock.

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/devices/relay_glove.h>
#include <glissade/devices/simulated_glove.h>

#include "allocation_counter.h"
#include "eventually.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// The greatest change of the force in a period; two periods count at most.
constexpr double kGreatestStep_N = 2.0 * 20.0 / 7.0 * (1.0 + 1e-9);

class Relay : public testing::Test {
 protected:
  /// A period of the driver, and of the server if it runs. The server answers the newest state by `wanted`.
  SafeCommand period() {
    clock.advance(milliseconds(1));
    state.time = clock.now() + milliseconds(123'456);  // the driver has a clock of its own
    glove.publish(state);
    if (server_runs && glove.read(seen)) {
      wanted.state_sequence = seen.sequence;
      wanted.state_time = seen.time;
      glove.command(at_server.limit(wanted, seen, clock.now()));
    }
    return glove.newest_command();
  }
  double force_after(int periods) {
    for (int i = 1; i < periods; ++i)
      period();
    return period().values().f_H_W.x();
  }

  const DeviceDescriptor descriptor = simulated_glove_descriptor();
  realtime::SimulatedClock clock;
  RelayGlove glove{descriptor, &clock};
  SafetyEnvelope at_server{descriptor};
  GloveState state;
  GloveState seen;
  GloveCommand wanted;
  bool server_runs = true;
};

TEST_F(Relay, StatesReachTheLoopNumbered) {
  EXPECT_FALSE(glove.read(seen)) << "there is no state yet";
  state.X_WH = Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(2.0, Vector3d(1, 2, 3).normalized());
  state.v_WH = Vector3d(1, 2, 3);
  state.joint_angles[7] = 0.5;
  state.grip = 2;
  state.sequence = 99;  // of the driver: without meaning here
  for (int i = 0; i < 3; ++i)
    glove.publish(state);
  ASSERT_TRUE(glove.read(seen));
  EXPECT_EQ(seen.sequence, 2);
  EXPECT_EQ(seen.X_WH.matrix(), state.X_WH.matrix());
  EXPECT_EQ(seen.v_WH, state.v_WH);
  EXPECT_EQ(seen.joint_angles, state.joint_angles);
  EXPECT_EQ(seen.grip, 2);
  EXPECT_GT(seen.link_delay, nanoseconds(0)) << "so only the envelope at the glove limits the energy";
  EXPECT_TRUE(glove.read(seen)) << "the newest state can be read again";
}

TEST_F(Relay, AForceComesSoftlyAndWithinTheLimits) {
  wanted.f_H_W.x() = 300.0;
  double last = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double force = period().values().f_H_W.x();
    EXPECT_LE(std::abs(force - last), 2.0 * 20.0 / 200.0) << "each envelope raises its share by 1/200 in a period";
    last = force;
  }
  EXPECT_DOUBLE_EQ(last, 20.0);
}

TEST_F(Relay, WithoutAStateOrACommandThereIsNoForce) {
  EXPECT_TRUE(glove.newest_command().values().is_at_rest());
  EXPECT_FALSE(glove.newest_command().reasons().any());
  server_runs = false;
  EXPECT_EQ(force_after(50), 0.0);
  EXPECT_TRUE(period().reasons().is_command_old);
}

TEST_F(Relay, TheForceOfASilentServerFadesAndReturnsSoftly) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_DOUBLE_EQ(force_after(400), 15.0);
  server_runs = false;
  double last = 15.0;
  int periods = 0;
  while (last > 0.0 && periods < 100) {
    const double force = period().values().f_H_W.x();
    EXPECT_LE(last - force, kGreatestStep_N);
    last = force;
    ++periods;
  }
  EXPECT_LE(periods, 6 + 7 + 1) << "six periods of patience and seven of the fade";
  EXPECT_EQ(force_after(1000), 0.0) << "nothing lasts";
  EXPECT_TRUE(period().reasons().is_command_old);
  server_runs = true;
  EXPECT_LT(force_after(10), 0.1 * 15.0);
  EXPECT_DOUBLE_EQ(force_after(400), 15.0);
}

TEST_F(Relay, ADriverThatWasStalledGetsNoForceOfThePast) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_DOUBLE_EQ(force_after(400), 15.0);
  clock.advance(milliseconds(500));
  const SafeCommand old = glove.newest_command();
  EXPECT_TRUE(old.reasons().is_state_old);
  EXPECT_LE(15.0 - old.values().f_H_W.x(), kGreatestStep_N) << "no jump, even now";
  EXPECT_LT(old.values().f_H_W.x(), 15.0);
}

TEST_F(Relay, StopsForGood) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_DOUBLE_EQ(force_after(400), 15.0);
  glove.stop();
  EXPECT_GT(force_after(1), 0.0);
  EXPECT_EQ(force_after(20), 0.0);
  EXPECT_TRUE(period().reasons().is_stopped);
  EXPECT_EQ(force_after(400), 0.0);
}

TEST_F(Relay, TheServerHearsWhatBecameOfItsCommands) {
  wanted.f_H_W.x() = 15.0;
  force_after(400);
  EXPECT_FALSE(seen.limits.is_fading());
  EXPECT_TRUE(seen.taken.has_value());
  server_runs = false;
  force_after(50);
  glove.read(seen);
  EXPECT_TRUE(seen.limits.is_command_old);
  EXPECT_GE(seen.command_age, milliseconds(48));
}

TEST_F(Relay, ADelayedServerIsADelayOfTheLink) {
  wanted.f_H_W.x() = 15.0;
  std::optional<SafeCommand> sent;
  for (int i = 0; i < 3000; ++i) {  // each command waits for a period
    period();
    if (sent) glove.command(*sent);
    glove.read(seen);
    wanted.state_time = seen.time;
    sent = at_server.limit(wanted, seen, clock.now());
    server_runs = false;
  }
  EXPECT_GE(seen.link_delay, milliseconds(1));
  EXPECT_LE(seen.link_delay, milliseconds(3));
}

TEST_F(Relay, WrongStatesTakeTheForceAway) {
  wanted.f_H_W.x() = 15.0;
  ASSERT_DOUBLE_EQ(force_after(400), 15.0);
  state.X_WH.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(period().reasons().not_finite);
  EXPECT_EQ(force_after(20), 0.0);
}

TEST_F(Relay, AllocatesNothing) {
  wanted.f_H_W.x() = 15.0;
  const std::int64_t before = test_support::allocations_of_this_thread();
  force_after(100);
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

TEST_F(Relay, ADescriptorThatIsWrongIsRefused) {
  DeviceDescriptor wrong = descriptor;
  wrong.max_force = -1.0;
  EXPECT_THROW(RelayGlove{wrong}, std::invalid_argument);
}

/// A driver and a loop in threads of their own: states arrive whole, and the force comes.
TEST(RelayThreads, HandOverWholeStatesAndForces) {
  DeviceDescriptor slow = simulated_glove_descriptor();
  slow.update_rate = 50.0;  // patient, because a busy machine may stop any thread for tens of milliseconds
  RelayGlove glove(slow);
  realtime::SteadyClock clock;
  std::atomic<bool> should_end{false};
  std::thread loop([&] {
    SafetyEnvelope envelope(slow);
    GloveState seen;
    GloveCommand wanted;
    wanted.f_H_W.x() = 5.0;
    while (!should_end) {
      std::this_thread::sleep_for(milliseconds(1));
      if (!glove.read(seen)) continue;
      for (const double angle : seen.joint_angles)
        EXPECT_EQ(angle, static_cast<double>(seen.grip));
      wanted.state_time = seen.time;
      glove.command(envelope.limit(wanted, seen, clock.now()));
    }
  });
  GloveState state;
  EXPECT_TRUE(eventually([&] {
    ++state.grip;
    state.joint_angles.fill(static_cast<double>(state.grip));
    state.time = clock.now();
    glove.publish(state);
    return glove.newest_command().values().f_H_W.x() > 4.0;
  }));
  should_end = true;
  loop.join();
}

}  // namespace
}  // namespace glissade::devices
