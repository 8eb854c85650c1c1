/// The passivity observer and controller.

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

TEST_F(Envelope, GivesAReducedForceBackToAHandThatRests) {
  push_at(0.0, 800);
  push_at(0.1, 500);
  double last = push_at(0.0, 20).values().f_H_W.x();
  EXPECT_NEAR(last, 4.0, 0.2);
  for (int i = 0; i < 3000; ++i) {
    const double force = push_at(0.0, 1).values().f_H_W.x();
    ASSERT_GE(force, last);
    ASSERT_LE(force, last + 0.1) << "softly";
    last = force;
  }
  EXPECT_EQ(last, 20.0);
}

/// 4 mm to and fro, 5 times a second: about 20 mJ.
TEST_F(Envelope, GivesNothingBackToAHandThatOscillates) {
  push_at(0.0, 800);
  push_at(0.1, 500);
  const auto round = [&] {
    push_at(-0.04, 100);
    return push_at(0.04, 100).energy();
  };
  for (int i = 0; i < 50; ++i)
    EXPECT_LT(round(), 0.01) << i;
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

}  // namespace
}  // namespace glissade::devices
