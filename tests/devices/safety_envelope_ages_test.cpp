/// The force fades where its basis is old, implausible or not permitted.

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "envelope_fixture.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST_F(Envelope, ForceFadesWithin10PeriodsWithoutStatesAndReturnsSoftly) {
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

/// A glove whose newest command is `age(period)` periods old. Returns the last command.
SafeCommand pulled_late(SafetyEnvelope& envelope, double rate, int periods, const std::function<int(int)>& age) {
  const auto time = [rate](int period) { return nanoseconds(std::llround(1e9 * period / rate)); };
  SafeCommand safe;
  for (int i = 200; i < 200 + periods; ++i) {
    GloveState state;
    state.sequence = i;
    state.time = time(i);
    GloveCommand late = pull(5.0);
    late.state_time = time(i - age(i));
    safe = envelope.limit(late, state, state.time);
  }
  return safe;
}

// The coupling must know each delay with which a command acts, else it is too stiff.
TEST(SafetyEnvelope, ASlowGloveObeysNoCommandThatIsTooOldToBeADelay) {
  DeviceDescriptor slow = kDevice;
  slow.update_rate = 30.0;
  SafetyEnvelope envelope(slow, 6.0);
  EXPECT_TRUE(is_zero(pulled_late(envelope, 30.0, 300, [](int) { return 5; }))) << "167 ms";
  EXPECT_FALSE(is_zero(pulled_late(envelope, 30.0, 300, [](int) { return 4; }))) << "133 ms";
  EXPECT_NEAR(1e-6 * static_cast<double>(envelope.link_delay().count()), 133.3, 0.1);
  EXPECT_TRUE(is_zero(pulled_late(envelope, 30.0, 300, [](int) { return 5; }))) << "167 ms, once 133 ms are known";
}

TEST(SafetyEnvelope, SilencesAreNoDelayOfTheLink) {
  SafetyEnvelope envelope(kDevice, 6.0);
  EXPECT_TRUE(is_zero(pulled_late(envelope, 1000.0, 20'100, [](int period) { return period % 150; })));
  EXPECT_LE(envelope.link_delay(), milliseconds(1));
}

TEST_F(Envelope, ReportedAgeOfAnOldStateIsItsOwn) {
  settle(pull(15.0));
  GloveCommand old = pull(15.0);
  old.state_time = state_.time - milliseconds(600);
  SafeCommand safe;
  for (int i = 0; i < 20; ++i) {
    now_ += milliseconds(1);
    safe = checked(envelope_.limit(old, state_, now_));
  }
  EXPECT_TRUE(safe.reasons().is_state_old);
  EXPECT_THAT(to_text(safe), testing::MatchesRegex("no force: the glove's state is 2. ms old"));
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

TEST_F(Envelope, ForceFadesWhenTheTrackerJumps) {
  settle(pull(15.0));
  state_.X_WH.translation().y() += 0.1;
  EXPECT_TRUE(tick(pull(15.0)).reasons().is_implausible);
  EXPECT_LE(periods_to_zero([&] { return tick(pull(15.0)); }), 8);
  const SafeCommand after = settle(pull(15.0));
  EXPECT_EQ(after.values().f_H_W.x(), 15.0) << "the hand is there now";
}

TEST_F(Envelope, StatesBeyondDescriptorLimitsAreImplausible) {
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

TEST_F(Envelope, PoseContradictingItsVelocityIsImplausible) {
  settle(pull(15.0));
  state_.v_WH.x() = 8.0;  // the pose stands still
  tick(pull(15.0));
  EXPECT_TRUE(tick(pull(15.0)).reasons().is_implausible);
}

TEST_F(Envelope, RepeatedPoseIsImplausibleBeyondDescriptorLimit) {
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

TEST_F(Envelope, ForceFadesAndReturnsWhenTheGloveClockGoesBack) {
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

TEST_F(Envelope, NumbersThatAreNotFiniteLetTheForceFade) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (std::size_t place = 0; place < 6 + hands::kJoints; ++place) {
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

}  // namespace
}  // namespace glissade::devices
