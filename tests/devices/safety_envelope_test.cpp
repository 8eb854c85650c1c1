#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "safe_command.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test_support::safe_command;

// What a device takes cannot be made of forces, nor changed.
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand>);
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand, LimitReasons>);
static_assert(!std::is_constructible_v<SafeCommand, GloveCommand, LimitReasons, nanoseconds>);
static_assert(!std::is_aggregate_v<SafeCommand>);
static_assert(!std::is_assignable_v<SafeCommand&, GloveCommand>);
static_assert(!std::is_assignable_v<decltype(std::declval<SafeCommand&>().values()), GloveCommand>);
static_assert(!std::is_invocable_v<decltype(&GloveDevice::command), GloveDevice&, GloveCommand>);
static_assert(!std::is_invocable_v<decltype(&SimulatedGlove::step), SimulatedGlove&, nanoseconds, GloveCommand>);

const DeviceDescriptor kDevice = simulated_glove_descriptor();  // 20 N, 1 Nm, 0.5 Nm a joint, 1000 Hz
constexpr double kForceStep_N = 20.0 / 7.0;                     // in a period
constexpr double kSlack = 1.0 + 1e-12;

GloveCommand pull(double newtons) {
  GloveCommand command;
  command.f_H_W.x() = newtons;
  return command;
}

bool is_zero(const SafeCommand& command) {
  const GloveCommand& values = command.values();
  return values.f_H_W.isZero(0.0) && values.t_H_W.isZero(0.0) && values.joint_torques == JointValues{};
}

/// A link of 1 kHz whose states are one millisecond old when they are answered. The clocks of glove and server differ.
class Envelope : public testing::Test {
 protected:
  /// One period with a new state.
  SafeCommand tick(GloveCommand wanted) {
    now_ += milliseconds(1);
    state_.time = now_ + kGloveClock - milliseconds(1);
    ++state_.sequence;
    wanted.state_time = state_.time;
    return checked(envelope_.limit(wanted, state_, now_));
  }

  /// One period in which no new state came.
  SafeCommand silent_tick(GloveCommand wanted) {
    now_ += milliseconds(1);
    wanted.state_time = state_.time;
    return checked(envelope_.limit(wanted, state_, now_));
  }

  /// So many periods of a hand that moves at `speed` along the wanted force of 20 N.
  SafeCommand push_at(double speed, int periods, double supply = 0.0) {
    state_.v_WH.x() = speed;
    SafeCommand safe;
    for (int i = 0; i < periods; ++i) {
      state_.X_WH.translation().x() += 1e-3 * speed;
      GloveCommand wanted = pull(20.0);
      wanted.sequence = ++sequence_;
      wanted.supply = supply;
      safe = tick(wanted);
    }
    return safe;
  }

  std::int64_t sequence_ = 0;  // of the commands of push_at

  SafeCommand settle(const GloveCommand& wanted) {
    SafeCommand safe;
    for (int i = 0; i < 500; ++i)
      safe = tick(wanted);
    return safe;
  }

  /// Number of periods until the force is zero.
  template <typename Tick>
  int periods_to_zero(Tick&& next) {
    for (int i = 1; i <= 100; ++i) {
      if (is_zero(next())) return i;
    }
    return -1;
  }

  /// Every command of every test keeps limit and rate.
  SafeCommand checked(const SafeCommand& safe) {
    EXPECT_LE(safe.values().f_H_W.norm(), kDevice.max_force);
    EXPECT_LE((safe.values().f_H_W - last_f_).norm(), kForceStep_N * kSlack);
    last_f_ = safe.values().f_H_W;
    return safe;
  }

  static constexpr nanoseconds kGloveClock = std::chrono::hours(5);

  SafetyEnvelope envelope_{kDevice};
  GloveState state_;
  nanoseconds now_{milliseconds(100)};
  Vector3d last_f_ = Vector3d::Zero();
};

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

TEST_F(Envelope, TurnsAForceNoFasterThanItsRate) {
  settle(pull(20.0));
  const SafeCommand safe = tick(pull(-20.0));
  EXPECT_NEAR(safe.values().f_H_W.x(), 20.0 - kForceStep_N, 1e-12);
  EXPECT_TRUE(safe.reasons().rate_limited);
}

TEST_F(Envelope, StatesThatStopLetTheForceFadeWithinTenPeriodsAndItReturnsSoftly) {
  settle(pull(15.0));
  const int periods = periods_to_zero([&] { return silent_tick(pull(15.0)); });
  EXPECT_GT(periods, 3) << "a late state is no reason";
  EXPECT_LE(periods, 11) << "ten after the deadline of the first state that is missing";
  const SafeCommand silent = silent_tick(pull(15.0));
  EXPECT_TRUE(silent.reasons().is_state_old);
  EXPECT_THAT(to_text(silent.reasons(), silent.age()),
              testing::MatchesRegex("no force: the glove's state is 1. ms old"));
  const SafeCommand back = tick(pull(15.0));
  EXPECT_LT(back.values().f_H_W.x(), 0.1);
  EXPECT_EQ(settle(pull(15.0)).values().f_H_W.x(), 15.0);
}

TEST_F(Envelope, ACommandThatAnswersAnOldStateFadesAlthoughNewStatesCome) {
  settle(pull(15.0));
  GloveCommand old = pull(15.0);
  old.state_time = state_.time;
  const auto next = [&] {
    tick(GloveCommand{});  // moves the clocks; its force falls too
    return checked(envelope_.limit(old, state_, now_));
  };
  EXPECT_LE(periods_to_zero(next), 11);
  EXPECT_TRUE(next().reasons().is_command_old);
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

TEST_F(Envelope, ACommandThatAnswersAStateOfTheFutureFades) {
  settle(pull(10.0));
  GloveCommand forged = pull(10.0);
  SafeCommand safe;
  for (int i = 0; i < 8; ++i) {
    now_ += milliseconds(1);
    state_.time += milliseconds(1);
    ++state_.sequence;
    forged.state_time = state_.time + std::chrono::seconds(1);
    safe = checked(envelope_.limit(forged, state_, now_));
  }
  EXPECT_TRUE(is_zero(safe));
  EXPECT_EQ(to_text(safe.reasons(), safe.age()), "no force: the command answers a state that never was");
}

TEST_F(Envelope, StatesThatArriveLateAreOldThoughTheyComeRegularly) {
  settle(pull(15.0));
  // From now on the link delays each state by 50 ms.
  for (int i = 0; i < 49; ++i)
    silent_tick(pull(15.0));
  const auto delayed_tick = [&] {
    now_ += milliseconds(1);
    state_.time = now_ + kGloveClock - milliseconds(50);
    ++state_.sequence;
    GloveCommand wanted = pull(15.0);
    wanted.state_time = state_.time;
    return envelope_.limit(wanted, state_, now_);
  };
  SafeCommand safe;
  for (int i = 0; i < 200; ++i)
    safe = delayed_tick();
  EXPECT_TRUE(is_zero(safe));
}

TEST_F(Envelope, AJumpOfTheTrackerFadesAndIsTold) {
  settle(pull(15.0));
  state_.X_WH.translation().y() += 0.1;
  EXPECT_TRUE(tick(pull(15.0)).reasons().is_implausible);
  EXPECT_LE(periods_to_zero([&] { return tick(pull(15.0)); }), 8);
  const SafeCommand after = settle(pull(15.0));
  EXPECT_EQ(after.values().f_H_W.x(), 15.0) << "the hand is there now";
}

TEST_F(Envelope, StatesThatContradictTheDescriptorAreNotBelieved) {
  const std::vector<std::pair<const char*, void (*)(GloveState&)>> spoilers = {
      {"speed", [](GloveState& s) { s.v_WH.x() = 11.0; }},
      {"turn rate", [](GloveState& s) { s.w_WH.z() = 101.0; }},
      {"workspace", [](GloveState& s) { s.X_WH.translation().x() = 1001.0; }},
      {"rotation", [](GloveState& s) { s.X_WH.rotate(Eigen::AngleAxisd(1.0, Vector3d::UnitZ())); }}};
  for (const auto& [name, spoil] : spoilers) {
    settle(pull(15.0));
    const GloveState good = state_;
    spoil(state_);
    EXPECT_TRUE(tick(pull(15.0)).reasons().is_implausible) << name;
    state_.X_WH = good.X_WH;
    state_.v_WH = good.v_WH;
    state_.w_WH = good.w_WH;
  }
}

TEST_F(Envelope, APoseThatContradictsItsVelocityIsNotBelieved) {
  settle(pull(15.0));
  state_.v_WH.x() = 8.0;  // the pose stands still
  tick(pull(15.0));
  EXPECT_TRUE(tick(pull(15.0)).reasons().is_implausible);
}

TEST_F(Envelope, AFrozenPoseIsNotBelievedWhereTheDeviceSaysSo) {
  DeviceDescriptor noisy = kDevice;
  noisy.frozen = milliseconds(50);
  envelope_ = SafetyEnvelope(noisy);
  SafeCommand safe;
  for (int i = 0; i < 500; ++i) {
    state_.X_WH.translation().x() = i % 2 == 0 ? 1e-6 : 0.0;
    safe = tick(pull(15.0));
  }
  EXPECT_FALSE(safe.reasons().is_implausible);
  for (int i = 0; i < 70; ++i)
    safe = tick(pull(15.0));
  EXPECT_TRUE(safe.reasons().is_implausible);
  EXPECT_TRUE(is_zero(safe));
}

TEST_F(Envelope, AGlovesClockThatGoesBackFadesAndIsFollowed) {
  settle(pull(15.0));
  now_ += milliseconds(1);
  state_.time -= std::chrono::hours(1);
  ++state_.sequence;
  const nanoseconds difference = now_ - state_.time;
  GloveCommand wanted = pull(15.0);
  wanted.state_time = state_.time;
  EXPECT_TRUE(checked(envelope_.limit(wanted, state_, now_)).reasons().is_implausible);
  SafeCommand safe;
  for (int i = 0; i < 600; ++i) {
    now_ += milliseconds(1);
    state_.time = now_ - difference;
    ++state_.sequence;
    wanted.state_time = state_.time;
    safe = checked(envelope_.limit(wanted, state_, now_));
  }
  EXPECT_EQ(safe.values().f_H_W.x(), 15.0);
}

TEST_F(Envelope, WithoutTheEnableSwitchThereIsNoForce) {
  settle(pull(15.0));
  state_.is_enabled = false;
  EXPECT_LE(periods_to_zero([&] { return tick(pull(15.0)); }), 8);
  state_.is_enabled = true;
  EXPECT_LT(tick(pull(15.0)).values().f_H_W.x(), 0.1) << "returns softly";
}

TEST_F(Envelope, TheEnableSwitchIsHeardAlsoWithoutANewMeasurement) {
  settle(pull(15.0));
  state_.is_enabled = false;  // same sequence, same time
  EXPECT_TRUE(silent_tick(pull(15.0)).reasons().is_disabled);
}

TEST_F(Envelope, AStateThatIsNotFiniteDoesNotHideADelay) {
  settle(pull(15.0));
  const double good = state_.X_WH.translation().x();
  state_.X_WH.translation().x() = std::numeric_limits<double>::infinity();
  silent_tick(pull(15.0));
  state_.X_WH.translation().x() = good;
  // From now on the states are 50 ms old.
  now_ += milliseconds(50);
  SafeCommand safe;
  for (int i = 0; i < 300; ++i) {
    now_ += milliseconds(1);
    state_.time += milliseconds(1);
    ++state_.sequence;
    GloveCommand wanted = pull(15.0);
    wanted.state_time = state_.time;
    safe = envelope_.limit(wanted, state_, now_);
  }
  EXPECT_TRUE(safe.reasons().is_state_old);
}

TEST_F(Envelope, AGloveThatObeysAnotherServerGetsNoForce) {
  state_.obeys_another = true;
  const SafeCommand safe = settle(pull(15.0));
  EXPECT_TRUE(is_zero(safe));
  EXPECT_EQ(to_text(safe.reasons(), safe.age()), "no force: the glove obeys another server");
}

TEST_F(Envelope, AnEmergencyStopIsForEver) {
  settle(pull(15.0));
  envelope_.stop();
  EXPECT_LE(periods_to_zero([&] { return tick(pull(15.0)); }), 8);
  EXPECT_TRUE(is_zero(settle(pull(15.0))));
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

TEST_F(Envelope, GivesBackNoMoreEnergyThanTheHandPutIn) {
  push_at(0.0, 800);
  const double at_start = push_at(0.0, 1).energy();
  EXPECT_EQ(at_start, 0.1);
  EXPECT_NEAR(push_at(-0.1, 50).energy(), at_start + 20.0 * 5e-3, 1e-3) << "20 N on a way of 5 mm";
  const SafeCommand safe = push_at(0.1, 500);
  EXPECT_LT(safe.values().f_H_W.x(), 0.5);
  EXPECT_GE(safe.energy(), 0.0);
  EXPECT_LT(safe.energy(), 0.006);
  EXPECT_TRUE(safe.reasons().energy_limited);
  EXPECT_EQ(to_text(safe.reasons(), safe.age()), "reduced force: it has given back all energy that the hand put in");
  const double at_rest = push_at(0.0, 10).values().f_H_W.x();
  EXPECT_NEAR(at_rest, 4.0, 0.2) << "a fifth is left";
  EXPECT_EQ(push_at(0.0, 10).values().f_H_W.x(), at_rest) << "and does not change while the hand is at rest";
  EXPECT_EQ(push_at(-0.1, 500).values().f_H_W.x(), 20.0) << "the hand has put in new energy";
}

TEST_F(Envelope, ForgetsTheEnergyOfAContactThatHasEnded) {
  push_at(0.0, 800);
  EXPECT_GT(push_at(-0.1, 200).energy(), 0.4);
  SafeCommand safe;
  for (int i = 0; i < 100; ++i)
    safe = tick(pull(0.0));
  EXPECT_EQ(safe.energy(), 0.1);
}

TEST_F(Envelope, GivesWhatBodiesThatMoveSupply) {
  double supply = 3.0;  // whatever the sender has counted before
  EXPECT_EQ(push_at(0.0, 800, supply).energy(), 0.1);
  for (int i = 0; i < 2000; ++i) {
    supply += 20.0 * 0.1e-3;
    EXPECT_EQ(push_at(0.1, 1, supply).values().f_H_W.x(), 20.0) << i;
  }
  EXPECT_NEAR(push_at(0.0, 1, supply).energy(), 0.1, 0.01) << "all of it was given";
  for (int i = 0; i < 300; ++i) {
    supply += 1.0;  // 1 kW
    EXPECT_LE(push_at(0.1, 1, supply).energy(), 5.0);
  }
}

TEST_F(Envelope, KeepsAsADebtWhatOthersTook) {
  push_at(0.0, 800, 1.0);
  EXPECT_NEAR(push_at(0.0, 200, 0.7).energy(), -0.2, 1e-9);
  EXPECT_NEAR(push_at(0.0, 200, 1.0).energy(), 0.1, 1e-9) << "taken and given back: nothing is gained";
}

TEST_F(Envelope, ASenderThatStartsAgainGivesNothing) {
  push_at(0.0, 800, 3.0);
  sequence_ = 0;
  EXPECT_EQ(push_at(0.0, 100, 0.0).energy(), 0.1);
}

/// Interruptions of 12 ms, every 0.6 s, with a hand that is lifted by 1 mm after each of them: 20 mJ.
TEST_F(Envelope, ManyInterruptionsFeedNothing) {
  push_at(0.0, 800);
  double given = 0.0;
  for (int round = 0; round < 100; ++round) {
    state_.is_enabled = false;
    push_at(0.0, 12);
    state_.is_enabled = true;
    push_at(0.0, 388);
    for (int i = 0; i < 200; ++i)
      given += 1e-3 * 0.05 * push_at(0.05, 1).values().f_H_W.x();
  }
  EXPECT_LT(given, 1.05 * (0.1 + 1.0 + 0.1 * 60.0)) << "in a minute";
}

TEST_F(Envelope, BehindALinkTheGlovesEnvelopeAloneLimitsTheEnergy) {
  state_.link_delay = milliseconds(3);
  EXPECT_EQ(push_at(0.0, 500).values().f_H_W.x(), 20.0);
  EXPECT_EQ(push_at(0.1, 500).values().f_H_W.x(), 20.0);
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

TEST_F(Envelope, NumbersThatAreNotFiniteLetTheForceFade) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (std::size_t place = 0; place < 6 + kGloveJoints; ++place) {
      GloveCommand wanted = settle(pull(15.0)).values();
      if (place < 3) {
        wanted.f_H_W[static_cast<Eigen::Index>(place)] = bad;
      } else if (place < 6) {
        wanted.t_H_W[static_cast<Eigen::Index>(place) - 3] = bad;
      } else {
        wanted.joint_torques[place - 6] = bad;
      }
      EXPECT_TRUE(tick(wanted).reasons().not_finite) << place;
      EXPECT_LE(periods_to_zero([&] { return tick(wanted); }), 8) << place;
    }
    state_.X_WH.translation().x() = bad;
    EXPECT_LE(periods_to_zero([&] { return tick(pull(15.0)); }), 8);
    state_.X_WH.translation().x() = 0.0;
  }
}

TEST(SafetyEnvelope, RefusesADescriptorThatIsNotValid) {
  DeviceDescriptor broken = kDevice;
  broken.max_force = std::numeric_limits<double>::quiet_NaN();
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
    if (random_() % 2 == 0) command_.joint_torques[random_() % kGloveJoints] = any_number(random_);
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
    for (std::size_t joint = 0; joint < kGloveJoints; ++joint) {
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
