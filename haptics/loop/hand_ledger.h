#pragma once

/// What the hands of a haptic loop owe each other.

#include <algorithm>
#include <array>
#include <cstddef>

#include <glissade/haptics/contact_set.h>

#include "loop/loop_settings.h"

namespace glissade::haptics {

/// Parts in the hands of others push a hand and yield to it. The energy for that passes through this ledger: a hand is
/// given only what other hands have given up before, as their envelopes tell (`SafeCommand::taken`). So all hands
/// together get no more than they have put in, whatever becomes of commands, and however wrong the forces are. What
/// nobody fetches or has given up within some seconds is forgotten, which makes the hands poorer only. Bodies that move
/// on their own give what they give; what is given back to them goes to no other hand. Real-time safe. Not thread-safe.
class HandLedger {
 public:
  /// Joules on the way into one hand in one tick; negative: the hand's work on the others.
  struct Flow {
    double from_hands = 0.0;
    double from_elsewhere = 0.0;
  };

  /// Once a tick, `dt` (seconds) after the last.
  void begin_tick(double dt) noexcept {
    const double kept = 1.0 - std::min(1.0, dt / kLoop.forgotten_s);
    given_up_ *= kept;
    for (Account& account : accounts_) {
      account.asked_for_hands *= kept;
      account.asked_for_others *= kept;
    }
  }

  /// `taken`: what the hand has given up so far. A count that falls has begun anew.
  void collect(std::size_t hand, double taken) noexcept {
    Account& account = accounts_[hand];
    const double more = std::max(0.0, taken - account.taken);
    account.taken = taken;
    const double for_others = std::min(more, account.asked_for_others);
    const double for_hands = std::min(more - for_others, account.asked_for_hands);
    account.asked_for_others -= for_others;
    account.asked_for_hands -= for_hands;
    given_up_ += for_hands;
  }

  /// Books what flows into the hand, as far as it is there. Returns `GloveCommand::supply`.
  double book(std::size_t hand, const Flow& flow) noexcept {
    Account& account = accounts_[hand];
    account.asked_for_hands += std::max(0.0, -flow.from_hands);
    account.asked_for_others += std::max(0.0, -flow.from_elsewhere);
    const double given = std::min(flow.from_hands, given_up_);
    given_up_ -= std::max(0.0, given);
    account.supply += given + flow.from_elsewhere;
    return account.supply;
  }

  /// What hands have given up, and no hand was given.
  double given_up() const noexcept { return given_up_; }

 private:
  struct Account {
    double supply = 0.0;
    double taken = 0.0;
    double asked_for_hands = 0.0;
    double asked_for_others = 0.0;
  };

  std::array<Account, hands::kMaxHands> accounts_{};
  double given_up_ = 0.0;
};

}  // namespace glissade::haptics
