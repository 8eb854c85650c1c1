/// The passivity observer and controller.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "envelope_fixture.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

TEST_F(Envelope, GivesBackNoMoreEnergyThanTheHandPutIn) {
  push_at(0.0, 800);
  const double at_start = push_at(0.0, 1).energy();
  EXPECT_EQ(at_start, 0.1);
  EXPECT_NEAR(push_at(-0.1, 50).energy(), at_start + 20.0 * 5e-3, 1e-3) << "20 N on a way of 5 mm";
  const SafeCommand safe = push_at(0.1, 500);
  EXPECT_LT(safe.values().f_H_W.x(), 1.7) << "by what recovers";
  EXPECT_GE(safe.energy(), 0.0);
  EXPECT_LT(safe.energy(), 0.007);
  EXPECT_TRUE(safe.reasons().energy_limited);
  EXPECT_EQ(to_text(safe.reasons(), safe.age()), "reduced force: it has given back all energy that the hand put in");
  EXPECT_EQ(push_at(-0.1, 500).values().f_H_W.x(), 20.0) << "the hand has put in new energy";
}

TEST_F(Envelope, ReducedForceRecoversForARestingHand) {
  push_at(0.0, 800);
  push_at(0.1, 500);
  double last = 0.0;
  for (int i = 1; i <= 100; ++i)
    last = push_at(0.1 - 1e-3 * i, 1).values().f_H_W.x();
  for (int i = 0; i < 2000; ++i) {
    const double force = push_at(0.0, 1).values().f_H_W.x();
    ASSERT_GE(force, last);
    ASSERT_LE(force, last + 0.5) << "softly";
    last = force;
  }
  EXPECT_EQ(last, 20.0);
}

/// 4 mm to and fro, 5 times a second: about 20 mJ each way.
TEST_F(Envelope, NoEnergyRecoversForAnOscillatingHand) {
  push_at(0.0, 800);
  push_at(0.1, 500);
  double given = 0.0;
  for (int ms = 0; ms < 10'000; ++ms) {
    const double speed = ms % 200 < 100 ? -0.04 : 0.04;
    given += 1e-3 * speed * push_at(speed, 1).values().f_H_W.x();
  }
  EXPECT_LT(given, 0.01) << "in ten seconds";
}

/// 0.35 mm to and fro, 10 times a second, as hands tremble.
TEST_F(Envelope, ReducedForceRecoversForATremblingHand) {
  push_at(0.0, 800);
  push_at(0.1, 500);
  double last = 0.0;
  for (int ms = 0; ms < 3000; ++ms)
    last = push_at(0.022 * std::sin(0.02 * std::numbers::pi * ms), 1).values().f_H_W.x();
  EXPECT_GT(last, 18.0);
}

/// A force of 20 N on the way out and less on the way back swings a hand to and fro. The mean power (W) that it gives
/// from 5 s on, when what was there at first is spent.
class SwungHand : public Envelope {
 protected:
  double power(int ms_of_swing, double speed, double newtons_back) {
    envelope_ = SafetyEnvelope(kDevice);
    last_f_.setZero();
    push_at(0.0, 800);
    push_at(0.1, 500);
    double given = 0.0;
    for (int ms = 0; ms < 7400; ++ms) {
      state_.v_WH.x() = ms % ms_of_swing < ms_of_swing / 2 ? -speed : speed;
      state_.X_WH.translation().x() += 1e-3 * state_.v_WH.x();
      if (ms >= 5000) given += 1e-3 * state_.v_WH.x() * last_f_.x();
      GloveCommand wanted = pull(state_.v_WH.x() > 0.0 ? 20.0 : newtons_back);
      wanted.session = session_;
      wanted.sequence = ++sequence_;
      tick(wanted);
    }
    return given / 2.4;
  }
};

/// 1.5 to 5.6 mm. Within each stroke, such a hand puts in more than it gets for a while.
TEST_F(SwungHand, GetsNothing) {
  for (const int ms : {200, 300, 400}) {
    for (const double speed : {0.015, 0.028}) {
      for (const double back : {18.0, 15.0, 10.0})
        EXPECT_LT(power(ms, speed, back), 1e-3) << ms << " ms, " << speed << " m/s, " << back << " N";
    }
  }
}

/// 0.2 to 0.8 mm: a part of this is within the play, and up to 5 mJ count as calm.
TEST_F(SwungHand, GetsLittleBySmallStrokes) {
  for (const int ms : {100, 200}) {
    for (const double speed : {0.004, 0.006, 0.008}) {
      for (const double back : {10.0, 5.0})
        EXPECT_LT(power(ms, speed, back), 0.06) << ms << " ms, " << speed << " m/s, " << back << " N";
    }
  }
}

TEST_F(Envelope, MotionOfStatesWithEqualTimesCountsAtTheNextTime) {
  push_at(0.0, 800);
  const double before = push_at(0.0, 1).energy();
  for (int i = 0; i < 4; ++i) {  // four states of a glove whose clock counts milliseconds
    state_.X_WH.translation().x() -= 0.25e-4;
    ++state_.sequence;
    GloveCommand wanted = pull(20.0);
    wanted.state_time = state_.time;
    envelope_.limit(wanted, state_, now_);
  }
  EXPECT_NEAR(push_at(0.0, 1).energy(), before + 20.0 * 1e-4, 1e-9);
}

TEST_F(Envelope, WorkCountsTheDelayedWrenchOfTheDevice) {
  DeviceDescriptor late = kDevice;
  late.delay = milliseconds(40);
  late.damping = 200.0;  // so that it is as stiff as without a delay
  late.max_force = 1.0;  // so that nothing needs to recover
  envelope_ = SafetyEnvelope(late);
  last_f_.setZero();
  for (int i = 0; i < 800; ++i)
    tick(pull(0.0));
  EXPECT_EQ(push_at(-0.1, 30).energy(), 0.1) << "the device exerts nothing yet";
  push_at(0.0, 100);
  EXPECT_NEAR(push_at(-0.1, 30).energy(), 0.1 + 1.0 * 3e-3, 1e-4) << "1 N on a way of 3 mm";
}

TEST_F(Envelope, WorkCountsACommandUntilTheWatchdogEndsIt) {
  push_at(0.0, 800);
  const double before = push_at(0.0, 1).energy();
  now_ += milliseconds(99);
  state_.X_WH.translation().x() -= 0.1;
  EXPECT_LE(push_at(0.0, 1).energy(), before) << "nobody knows when the hand went in";
  now_ += milliseconds(99);
  state_.X_WH.translation().x() += 0.1;
  EXPECT_GT(push_at(0.0, 1).energy(), before - 0.1) << "20 N on all of the way would be 2 J";
}

/// A tracker that repeats its last pose for 40 ms while the hand goes on.
TEST_F(Envelope, JumpAfterARepeatedPoseCountsAsMotion) {
  push_at(0.0, 800);
  push_at(-0.1, 200);
  const double before = push_at(0.0, 40).energy();
  state_.X_WH.translation().x() += 0.02;  // 20 mm in a millisecond
  EXPECT_TRUE(push_at(0.0, 1).reasons().is_implausible);
  EXPECT_NEAR(push_at(0.0, 1).energy(), before - 20.0 * 0.02, 0.1);
}

/// It may have been the tracker that jumped.
TEST_F(Envelope, AJumpTakesTheForceForNoLongerThanTwoSeconds) {
  push_at(0.0, 1000);
  state_.X_WH.translation().x() += 0.3;  // 6 J
  push_at(0.0, 2);
  EXPECT_LT(push_at(0.0, 200).values().f_H_W.x(), 18.0);
  EXPECT_GT(push_at(0.0, 1800).values().f_H_W.x(), 18.0);
}

/// Once in 0.8 s, outwards at 1.5 m/s for 60 ms, while the descriptor allows 1 m/s; and back without a force.
TEST_F(Envelope, MotionBeyondTheMaximumSpeedCounts) {
  DeviceDescriptor slow = kDevice;
  slow.max_speed = 1.0;
  envelope_ = SafetyEnvelope(slow);
  last_f_.setZero();
  double given = 0.0;
  for (int ms = 0; ms < 30'000; ++ms) {
    const bool is_fast = ms % 800 >= 700 && ms % 800 < 760;
    const bool is_back = ms % 800 >= 760;
    state_.X_WH.translation().x() += is_fast ? 1.5e-3 : is_back ? -2.25e-3 : 0.0;
    const double force = tick(pull(is_back ? 0.0 : 20.0)).values().f_H_W.x();
    given += (is_fast ? 1.5e-3 : is_back ? -2.25e-3 : 0.0) * force;
  }
  EXPECT_LE(given, 2.0 * 0.6 + 0.1 + 1.0 + 0.3 * 30.0);
}

TEST_F(Envelope, DebtOfRepeatedJumpsIsNotForgotten) {
  push_at(0.0, 1000);
  double given = 0.0;
  for (int round = 0; round < 20; ++round) {  // in 14 seconds
    push_at(0.0, 600);
    const double force = push_at(0.0, 99).values().f_H_W.x();  // the pose repeats while the hand goes on at 3 m/s
    state_.X_WH.translation().x() += 0.3;
    given += 0.3 * force;
    push_at(0.0, 1);
  }
  EXPECT_LE(given, 6.0 + 6.0 + 0.1 + 1.0 + 0.3 * 14.0) << "the first 6 J were forgiven, the last are still a debt";
}

TEST_F(Envelope, AJumpAgainstTheForceBringsNoEnergy) {
  const double before = push_at(0.0, 1000).energy();
  state_.X_WH.translation().x() -= 0.3;
  push_at(0.0, 1);
  EXPECT_LE(push_at(0.0, 1).energy(), before);
}

TEST_F(Envelope, ImpossibleJumpDoesNotCountAsMotion) {
  push_at(0.0, 800);
  push_at(-0.1, 200);
  const double before = push_at(0.0, 40).energy();
  state_.X_WH.translation().x() += 2.0;  // the tracker was aligned anew
  push_at(0.0, 1);
  EXPECT_NEAR(push_at(0.0, 1).energy(), before, 0.1);
}

/// The device exerts half of each period what it was told in the one before.
TEST_F(Envelope, StepOfTheGloveClockAddsNoEnergy) {
  DeviceDescriptor late = kDevice;
  late.delay = std::chrono::microseconds(500);
  envelope_ = SafetyEnvelope(late);
  last_f_.setZero();
  push_at(0.0, 800);
  push_at(-0.1, 50);
  const double before = push_at(-0.05, 1).energy();
  now_ += milliseconds(1);
  state_.time += std::chrono::hours(1);
  ++state_.sequence;
  GloveCommand wanted = pull(20.0);
  wanted.state_time = state_.time;
  EXPECT_NEAR(envelope_.limit(wanted, state_, now_).energy(), before, 0.01);
}

TEST_F(Envelope, ForgetsTheEnergyOfAContactThatHasEnded) {
  push_at(0.0, 800);
  EXPECT_GT(push_at(-0.1, 200).energy(), 0.4);
  SafeCommand safe;
  for (int i = 0; i < 100; ++i)
    safe = tick(pull(0.0));
  EXPECT_EQ(safe.energy(), 0.1);
}

TEST_F(Envelope, SupplyAddsEnergyUpToMaximumPower) {
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

TEST_F(Envelope, KeepsNoSupplyWhileThereIsNoForce) {
  push_at(0.0, 800);
  state_.is_enabled = false;
  push_at(0.0, 50);
  double supply = 0.0;
  for (int i = 0; i < 500; ++i) {
    supply += 0.01;
    EXPECT_LE(push_at(0.0, 1, supply).energy(), 0.1) << i;
  }
  state_.is_enabled = true;
  EXPECT_EQ(push_at(0.0, 1000, supply).energy(), 0.1);
}

TEST_F(Envelope, AvailableEnergyIsGivenUpOnRequestOfOtherHands) {
  push_at(0.0, 800, 1.0);
  const double put_in = push_at(-0.1, 100, 1.0).energy() - 0.1;
  EXPECT_NEAR(put_in, 0.2, 0.01);
  const SafeCommand asked = push_at(0.0, 1, 0.85);
  EXPECT_NEAR(asked.taken(), 0.15, 1e-9);
  EXPECT_NEAR(asked.energy(), 0.1 + put_in - 0.15, 1e-9);
  const SafeCommand poor = push_at(0.0, 10, -20.0);
  EXPECT_NEAR(poor.taken(), put_in, 1e-9) << "no more than there is";
  EXPECT_EQ(poor.energy(), 0.1);
  EXPECT_EQ(poor.values().f_H_W.x(), 20.0) << "and no force shrinks for that";
  EXPECT_NEAR(push_at(0.0, 10, -19.9).energy(), 0.1, 1e-9) << "asked for less: nothing is gained";
  push_at(0.0, 10'000, -19.9);
  EXPECT_GT(push_at(-0.1, 100, -19.9).energy(), 0.25) << "after some seconds nobody asks for it any more";
}

TEST_F(Envelope, SupplyCountsByTheExertedShareOfForce) {
  push_at(0.0, 800);
  DeviceDescriptor weak = kDevice;
  weak.max_force = 5.0;
  envelope_ = SafetyEnvelope(weak);
  last_f_.setZero();
  push_at(0.0, 800);
  const double before = push_at(-0.01, 100).energy();
  EXPECT_NEAR(push_at(0.0, 1, 0.4).energy() - before, std::min(0.1, kDevice.max_power * 1e-3), 1e-3)
      << "a quarter of 20 N, and no more than the largest power";
}

/// 20 N for a second, then nothing for half a second, then another server; which counts from anywhere.
TEST_F(Envelope, AServerThatTakesOverChangesNoEnergy) {
  for (const std::int64_t sequence : {0, 100'000}) {
    for (const double supply : {-3.0, 3.0}) {
      push_at(0.0, 1000);
      for (int i = 0; i < 500; ++i) {
        now_ += milliseconds(1);
        state_.time += milliseconds(1);
        ++state_.sequence;
        GloveCommand old = pull(20.0);
        old.sequence = sequence_;
        old.state_time = milliseconds(1);
        checked(envelope_.limit(old, state_, now_));
      }
      sequence_ = sequence;
      EXPECT_EQ(push_at(0.0, 500, supply).energy(), 0.1) << sequence << ", " << supply;
    }
  }
}

TEST_F(Envelope, ASenderOfAnotherSessionCountsAnew) {
  push_at(0.0, 800, 3.0);
  session_ = 2;
  EXPECT_EQ(push_at(0.0, 100, 5.0).energy(), 0.1);
  sequence_ = 0;
  EXPECT_EQ(push_at(0.0, 100, 8.0).energy(), 0.1) << "and so does one that starts again";
}

/// Interruptions of 12 ms, every 0.6 s, with a hand that is lifted by 1 mm after each of them: 20 mJ.
TEST_F(Envelope, EnergyOfManyInterruptionsStaysWithinTheAllowance) {
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
  EXPECT_LT(given, 1.05 * (0.1 + 1.0 + 0.3 * 60.0)) << "in a minute";
}

TEST_F(Envelope, BehindALinkTheGlovesEnvelopeAloneLimitsTheEnergy) {
  state_.link_delay = milliseconds(3);
  EXPECT_EQ(push_at(0.0, 500).values().f_H_W.x(), 20.0);
  EXPECT_EQ(push_at(0.1, 500).values().f_H_W.x(), 20.0);
}

}  // namespace
}  // namespace glissade::devices
