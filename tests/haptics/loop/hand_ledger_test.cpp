// What hands owe each other.

#include "loop/hand_ledger.h"

#include <gtest/gtest.h>

namespace glissade::haptics {
namespace {

TEST(HandLedger, AHandIsGivenOnlyWhatAnotherHasGivenUp) {
  HandLedger ledger;
  EXPECT_EQ(ledger.book(0, {.from_hands = -0.5}), -0.5) << "it is asked for";
  EXPECT_EQ(ledger.book(1, {.from_hands = 0.5}), 0.0) << "nothing is there yet";
  ledger.collect(0, 0.3);
  EXPECT_EQ(ledger.book(1, {.from_hands = 0.5}), 0.3);
  EXPECT_EQ(ledger.given_up(), 0.0);
}

TEST(HandLedger, GivenUpEnergyIsAtMostTheRequest) {
  HandLedger ledger;
  ledger.book(0, {.from_hands = -0.5});
  ledger.collect(0, 2.0);
  EXPECT_EQ(ledger.given_up(), 0.5);
  ledger.collect(0, 0.1);
  EXPECT_EQ(ledger.given_up(), 0.5) << "the count began anew";
}

TEST(HandLedger, EnergyReturnedToAMoverGoesToNoHand) {
  HandLedger ledger;
  EXPECT_EQ(ledger.book(0, {.from_elsewhere = 0.5}), 0.5) << "a mover needs nobody's leave";
  EXPECT_EQ(ledger.book(0, {.from_elsewhere = -0.4}), 0.5 - 0.4);
  ledger.book(0, {.from_hands = -0.2});
  ledger.collect(0, 0.5);
  EXPECT_NEAR(ledger.given_up(), 0.1, 1e-12);
}

TEST(HandLedger, UnclaimedEnergyExpires) {
  HandLedger ledger;
  ledger.book(0, {.from_hands = -0.5});
  ledger.collect(0, 0.5);
  for (int ms = 0; ms < 5000; ++ms)
    ledger.begin_tick(1e-3);
  EXPECT_LT(ledger.given_up(), 0.01);
}

}  // namespace
}  // namespace glissade::haptics
