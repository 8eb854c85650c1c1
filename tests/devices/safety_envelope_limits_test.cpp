/// Norms, rates and powers within the limits of the device, whatever is wanted.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

#include "envelope_fixture.h"
#include "safe_command.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// What a device takes cannot be made of forces, nor changed.
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand>);
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand, LimitReasons>);
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand, LimitReasons, nanoseconds>);
static_assert(!std::is_aggregate_v<SafeCommand>);
static_assert(!std::is_assignable_v<SafeCommand&, GloveCommand>);
static_assert(!std::is_assignable_v<decltype(std::declval<SafeCommand&>().values()), GloveCommand>);
static_assert(!std::is_invocable_v<decltype(&GloveDevice::command), GloveDevice&, GloveCommand>);
static_assert(!std::is_invocable_v<decltype(&SimulatedGlove::step), SimulatedGlove&, nanoseconds, GloveCommand>);

TEST_F(Envelope, StartsSoftly) {
  EXPECT_TRUE(is_zero(tick(pull(10.0))));
  SafeCommand safe;
  for (int i = 0; i < 100; ++i)
    safe = tick(pull(10.0));
  EXPECT_NEAR(safe.values().f_H_W.x(), 5.0, 1e-9);
  EXPECT_TRUE(safe.reasons().is_returning);
  EXPECT_EQ(to_text(safe.reasons(), safe.age()), "reduced force: it returns softly");
  safe = settle(pull(10.0));
  EXPECT_EQ(safe.values().f_H_W.x(), 10.0);
  EXPECT_FALSE(safe.reasons().any());
}

TEST_F(Envelope, LeavesACommandWithinTheLimitsAlone) {
  GloveCommand wanted = pull(-20.0);
  wanted.sequence = 3;
  wanted.state_sequence = 2;
  wanted.t_H_W = Vector3d(0.6, 0, 0.8);
  wanted.joint_torques[7] = -0.5;
  const SafeCommand safe = settle(wanted);
  EXPECT_FALSE(safe.reasons().any());
  EXPECT_EQ(safe.values().f_H_W, wanted.f_H_W);
  EXPECT_EQ(safe.values().t_H_W, wanted.t_H_W);
  EXPECT_EQ(safe.values().joint_torques, wanted.joint_torques);
  EXPECT_EQ(safe.values().sequence, 3);
  EXPECT_EQ(safe.values().state_sequence, 2);
}

TEST_F(Envelope, ScalesDownToTheLimitsAndSaysWhich) {
  GloveCommand wanted;
  wanted.f_H_W = Vector3d(3e5, 0, 4e5);
  SafeCommand safe = settle(wanted);
  EXPECT_TRUE(safe.values().f_H_W.isApprox(Vector3d(12, 0, 16), 1e-14));
  EXPECT_TRUE(safe.reasons().force_limited);
  EXPECT_FALSE(safe.reasons().torque_limited || safe.reasons().joints_limited);
  wanted = {};
  wanted.t_H_W = Vector3d(0, 2, 0);
  wanted.joint_torques[3] = -0.6;
  safe = settle(wanted);
  EXPECT_TRUE(safe.reasons().torque_limited && safe.reasons().joints_limited);
  EXPECT_FALSE(safe.reasons().force_limited);
  EXPECT_EQ(safe.values().t_H_W, Vector3d(0, 1, 0));
  EXPECT_EQ(safe.values().joint_torques[3], -0.5);
}

// It would otherwise be at its limit at each contact.
TEST(EnvelopeOfATracker, WhatADeviceDoesNotExertIsNoLimit) {
  DeviceDescriptor tracker = simulated_glove_descriptor();
  tracker.max_force = tracker.max_torque = tracker.max_joint_torque = 0.0;
  GloveCommand wanted;
  wanted.f_H_W = Vector3d(1, 2, 3);
  wanted.t_H_W = Vector3d(0.1, 0.2, 0.3);
  wanted.joint_torques[3] = -0.6;
  const SafeCommand safe = test_support::safe_command(wanted, tracker);
  EXPECT_TRUE(safe.values().is_at_rest());
  EXPECT_FALSE(safe.reasons().any());
}

TEST_F(Envelope, TurnsAForceNoFasterThanItsRate) {
  settle(pull(20.0));
  const SafeCommand safe = tick(pull(-20.0));
  EXPECT_NEAR(safe.values().f_H_W.x(), 20.0 - kForceStep_N, 1e-12);
  EXPECT_TRUE(safe.reasons().rate_limited);
}

TEST_F(Envelope, HugeFiniteVelocitiesLeaveTheForceFinite) {
  settle(pull(10.0));
  GloveCommand wanted = pull(10.0);
  wanted.f_H_W.y() = 10.0;
  state_.v_WH = Vector3d(1e308, -1e308, 0.0);
  EXPECT_TRUE(tick(wanted).values().f_H_W.allFinite());
  state_.v_WH.setZero();
  EXPECT_NEAR(settle(pull(10.0)).values().f_H_W.x(), 10.0, 1e-9);
}

TEST_F(Envelope, ACallerThatPausedGetsNoMoreThanTwoPeriodsOfChange) {
  for (int i = 0; i < 40; ++i)
    tick(pull(15.0));
  const double before = last_f_.x();
  now_ += std::chrono::seconds(1);
  state_.time = now_ + kGloveClock - milliseconds(1);
  ++state_.sequence;
  GloveCommand wanted = pull(15.0);
  wanted.state_time = state_.time;
  const double after = envelope_.limit(wanted, state_, now_).values().f_H_W.x();
  EXPECT_LE(std::abs(after - before), 2.0 * kForceStep_N * kSlack);
}

TEST_F(Envelope, LimitsThePowerIntoTheHand) {
  DeviceDescriptor weak = kDevice;
  weak.max_power = 5.0;
  envelope_ = SafetyEnvelope(weak);
  EXPECT_EQ(push_at(-0.5, 500).values().f_H_W.x(), 20.0) << "the hand puts power into the device";
  const SafeCommand safe = push_at(0.5, 20);  // 20 N at this speed are 10 W
  EXPECT_NEAR(safe.values().f_H_W.x(), 10.0, 1e-9);
  EXPECT_TRUE(safe.reasons().power_limited);
}

TEST_F(Envelope, LimitsTheMeanForce) {
  DeviceDescriptor warm = kDevice;
  warm.max_mean_force = 8.0;
  envelope_ = SafetyEnvelope(warm);
  SafeCommand safe;
  for (int i = 0; i < 60'000; ++i)
    safe = tick(pull(20.0));
  EXPECT_LT(safe.values().f_H_W.x(), 8.0 * 1.01);
  EXPECT_GT(safe.values().f_H_W.x(), 7.0);
  EXPECT_TRUE(safe.reasons().mean_limited);
}

TEST(SafetyEnvelope, MeanForceIsReachedByLessThanAPercentInAPeriod) {
  for (const double rate : {1000.0, 500.0, 100.0, 30.0}) {
    for (const double share : {0.5, 0.3, 0.1, 0.05}) {
      DeviceDescriptor warm = kDevice;
      warm.update_rate = rate;
      warm.max_mean_force = share * warm.max_force;
      SafetyEnvelope envelope(warm);
      GloveState state;
      GloveCommand pull;
      pull.f_H_W.x() = warm.max_force;
      double last = 0.0;
      for (int i = 1; i < 60.0 * rate; ++i) {
        state.sequence = pull.sequence = pull.state_sequence = i;
        state.time = pull.state_time = nanoseconds(static_cast<std::int64_t>(1e9 * i / rate));
        const double force = envelope.limit(pull, state, state.time).values().f_H_W.x();
        ASSERT_GE(force, 0.99 * last) << rate << " Hz, mean " << share << ", period " << i;
        last = force;
      }
      EXPECT_NEAR(last, warm.max_mean_force, 0.01 * warm.max_mean_force) << rate << " Hz, mean " << share;
    }
  }
}

// `passivity_test` has the reason: what cannot fall soon would go on giving energy.
TEST(SafetyEnvelope, LowMaximumForceRateLowersTheMaximumForce) {
  DeviceDescriptor device = kDevice;
  device.max_force_rate = 500.0;
  EXPECT_DOUBLE_EQ(SafetyEnvelope(device).descriptor().max_force, 500.0 * 15.0 / device.update_rate);
  device.max_force_rate = 0.0;
  EXPECT_EQ(SafetyEnvelope(device).descriptor().max_force, kDevice.max_force);
}

TEST(SafetyEnvelope, RefusesADescriptorThatIsNotValid) {
  DeviceDescriptor broken = kDevice;
  broken.max_force = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SafetyEnvelope{broken}, std::invalid_argument);
  broken.max_force = 1e300;  // its square would overflow
  EXPECT_THROW(SafetyEnvelope{broken}, std::invalid_argument);
}

/// A number of any size, now and then none at all.
double any_number(std::mt19937_64& random) {
  std::uniform_int_distribution<int> kind(0, 50);
  switch (kind(random)) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return -std::numeric_limits<double>::infinity();
    case 2:
      return 1e308;
    case 3:
      return -1e308;
    default:
      return std::normal_distribution<double>(0.0, std::pow(10.0, kind(random) % 31))(random);
  }
}

Vector3d any_vector(std::mt19937_64& random) {
  return {any_number(random), any_number(random), any_number(random)};
}

/// A hand that moves as hands do, at up to some metres per second, and a server that wants all kinds of forces. Now and
/// then, both say anything at all for a moment.
class RandomHand {
 public:
  explicit RandomHand(std::uint64_t seed) : random_(seed) {}

  /// The next period, which lasts up to 1 ms, rarely longer.
  void step() {
    dt_ = random_() % 10'000 == 0 ? nanoseconds(random_() % 2'000'000'000) : nanoseconds(random_() % 1'000'000);
    now_ += dt_;
    move(std::chrono::duration<double>(dt_).count());
    if (random_() % 40 == 0) want_another_force();
    state_ = good_;
    command_ = wanted_;
    command_.state_time = state_.time;
    if (random_() % 3000 == 0) say_anything();
  }

  nanoseconds now() const { return now_; }
  double period_s() const { return std::chrono::duration<double>(std::min<nanoseconds>(dt_, milliseconds(2))).count(); }
  const GloveState& state() const { return state_; }
  const GloveCommand& command() const { return command_; }
  bool is_state_finite() const {
    return state_.v_WH.allFinite() && state_.w_WH.allFinite() && state_.X_WH.translation().allFinite() &&
           std::abs(static_cast<double>(state_.time.count())) < 2e18;
  }

 private:
  Vector3d normal(double deviation) {
    std::normal_distribution<double> number(0.0, deviation);
    return {number(random_), number(random_), number(random_)};
  }

  void move(double dt) {
    const Vector3d v_before = good_.v_WH;
    good_.v_WH = (good_.v_WH + normal(0.1)) * 0.998;
    good_.w_WH = (good_.w_WH + normal(0.5)) * 0.998;
    good_.X_WH.translation() = 0.9999 * good_.X_WH.translation() + 0.5 * dt * (v_before + good_.v_WH);
    good_.time = now_;
    ++good_.sequence;
    good_.is_enabled = good_.is_enabled ? random_() % 50'000 != 0 : random_() % 50 == 0;
  }

  void want_another_force() {
    wanted_.f_H_W = normal(15.0);
    wanted_.t_H_W = normal(0.7);
    for (double& torque : wanted_.joint_torques)
      torque = normal(0.4).x();
  }

  void say_anything() {
    if (random_() % 2 == 0) command_.f_H_W = any_vector(random_);
    if (random_() % 2 == 0) command_.t_H_W = any_vector(random_);
    if (random_() % 2 == 0) command_.joint_torques[random_() % hands::kJoints] = any_number(random_);
    if (random_() % 4 == 0) command_.supply = any_number(random_);
    if (random_() % 4 == 0) command_.state_time = nanoseconds(static_cast<std::int64_t>(random_()));
    if (random_() % 4 == 0) state_.time = nanoseconds(static_cast<std::int64_t>(random_()));
    if (random_() % 2 == 0) state_.v_WH = any_vector(random_);
    if (random_() % 2 == 0) state_.w_WH = any_vector(random_);
    if (random_() % 2 == 0) state_.X_WH.translation() = any_vector(random_);
  }

  std::mt19937_64 random_;
  nanoseconds now_{0};
  nanoseconds dt_{0};
  GloveState good_;
  GloveState state_;
  GloveCommand wanted_;
  GloveCommand command_;
};

// Ten million calls: GLISSADE_ENVELOPE_CALLS=10000000.
TEST(SafetyEnvelope, NoRandomCommandOrStateBreaksALimit) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  const char* const wish = std::getenv("GLISSADE_ENVELOPE_CALLS");
  const int calls = wish != nullptr ? std::atoi(wish) : 100'000;
  constexpr double kTolerance = 1e-12;
  DeviceDescriptor device = kDevice;
  device.max_force_rate = 1500.0;
  device.max_torque_rate = 120.0;
  device.max_joint_torque_rate = 40.0;
  device.max_power = 3.0;
  RandomHand hand(kSeed);
  SafetyEnvelope server(device);
  SafetyEnvelope glove(device, 6.0);
  GloveCommand last;
  int pressing = 0;
  int at_the_power = 0;
  for (int i = 0; i < calls; ++i) {
    hand.step();
    const SafeCommand sent = server.limit(hand.command(), hand.state(), hand.now());
    const GloveCommand out = glove.limit(sent.values(), hand.state(), hand.now()).values();
    ASSERT_LE(out.f_H_W.norm(), kDevice.max_force) << i;
    ASSERT_LE(out.t_H_W.norm(), kDevice.max_torque) << i;
    const double dt = hand.period_s();
    const double f_step = (out.f_H_W - last.f_H_W).norm();
    const double t_step = (out.t_H_W - last.t_H_W).norm();
    ASSERT_LE(f_step, device.max_force_rate * dt * kSlack + kTolerance) << i;
    ASSERT_LE(t_step, device.max_torque_rate * dt * kSlack + kTolerance) << i;
    for (std::size_t joint = 0; joint < hands::kJoints; ++joint) {
      ASSERT_LE(std::abs(out.joint_torques[joint]), kDevice.max_joint_torque) << i;
      ASSERT_LE(std::abs(out.joint_torques[joint] - last.joint_torques[joint]),
                device.max_joint_torque_rate * dt * kSlack + kTolerance)
          << i;
    }
    // The power is within its limit, or the wrench goes there as fast as its rates allow.
    const double power = out.f_H_W.dot(hand.state().v_WH) + out.t_H_W.dot(hand.state().w_WH);
    if (hand.is_state_finite() && power > device.max_power * 1.000001) {
      ASSERT_TRUE(f_step >= 0.999999 * dt * device.max_force_rate || t_step >= 0.999999 * dt * device.max_torque_rate)
          << i << ": " << power << " W";
    }
    pressing += out.f_H_W.norm() > 5.0 ? 1 : 0;
    at_the_power += power > 0.999 * device.max_power ? 1 : 0;
    last = out;
  }
  // The limits were put to the test.
  EXPECT_GT(pressing, calls / 3);
  EXPECT_GT(at_the_power, calls / 200);
}

}  // namespace
}  // namespace glissade::devices
