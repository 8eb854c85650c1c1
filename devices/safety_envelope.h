#pragma once

/// The safety envelope: the only way from a wanted command to a device. It keeps every limit of the device's
/// descriptor, and lets the force fade whenever its basis is old, implausible or not permitted.

#include <chrono>
#include <memory>
#include <string>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

/// A command that a device may execute. Only `SafetyEnvelope` makes one that is not zero.
class SafeCommand {
 public:
  /// No force.
  SafeCommand() = default;

  /// Sequences, times, forces and torques.
  const GloveCommand& values() const noexcept { return values_; }
  const LimitReasons& reasons() const noexcept { return reasons_; }
  /// Time since the measurement of the state that the command answers.
  std::chrono::nanoseconds age() const noexcept { return age_; }
  /// Time since the measurement of the glove's newest state.
  std::chrono::nanoseconds state_age() const noexcept { return state_age_; }
  /// Energy (J) that force and torque may still give to the hand: `SafetyEnvelope`.
  double energy() const noexcept { return energy_; }
  /// Energy (J) that the hand has given up for others since the last interruption: `GloveState::taken`.
  double taken() const noexcept { return taken_; }

 private:
  friend class SafetyEnvelope;

  GloveCommand values_;
  LimitReasons reasons_;
  std::chrono::nanoseconds age_{0};
  std::chrono::nanoseconds state_age_{0};
  double energy_ = 0.0;
  double taken_ = 0.0;
};

/// The most serious reason in plain words, such as "no force: the glove's state is 14 ms old"; empty without reasons.
/// `age` is that of the newest state if this is old, else `SafeCommand::age`.
std::string to_text(const LimitReasons& reasons, std::chrono::nanoseconds age);
std::string to_text(const SafeCommand& command);

/// One envelope stands before each device: one at the server's end of a link and one at the glove's end, or one alone
/// for a device in the server's process. It remembers the last command and the last state, so call it once a period.
///
/// Ages are measured from the times of measurement that states carry. The clock of the glove and that of the caller may
/// differ: the fastest message so far gives the difference, which may grow by 0.2 ms a second. If all states
/// that come within a second are late while their own time goes on, or if the glove's clock goes back, the difference
/// is taken anew.
///
/// A passivity observer counts the work of force and torque on the hand, by the measured motion and the commands
/// that were given, i.e. after all limits: each from the delay of the device on, until the next acts, for 10 ms at
/// most. The energy is what the hand has put in and not got back, at most 0.25 m times the largest force, and 0.1 J at
/// the start for errors of sampling. The wrench is a continuous function of the energy and the velocity: it is never
/// greater than what is left could bring to zero as a spring does that the device renders passively (docs/safety.md has
/// the derivation). When there is no contact any more, the energy is at most 0.1 J. Below 0.1 J, or what the wanted
/// wrench needs, it recovers: without a contact by 0.3 W; in a calm one, in which the hand moves by less than 30 mm/s
/// along the force and less than 10 mJ went to and fro in about the last half second, by up to 0.5 W; while such a hand
/// trembles, by 0.15 W; at once while the force returns from an interruption and up to half a second after. All this
/// together is at most 1 J and 0.25 W. Noise within four times the descriptor's `resolution` is no motion. For a glove
/// that tells the delay of its link, the envelope at the glove's end does this alone. So no delay and no error of the
/// simulation can feed an oscillation that gives more than 20 mW and is faster than that, and a hand at rest feels no
/// jump. Joint torques are not counted. Sources: Hannaford and Ryu, Time-domain passivity control of haptic interfaces,
/// 2002, for the observer; Franken et al., Bilateral telemanipulation with time delays: a two-layer approach combining
/// passivity and transparency, 2011, for the shrinking with the energy in a tank and for tanks that pass energy on.
///
/// What moves without the hand may push it. `GloveCommand::supply` tells the energy for that. A rise of `supply` counts
/// as energy that the hand has put in. Only a share of the rise counts: the share of the wanted wrench that was
/// exerted. The amount is at most the largest power of the device times the time since the last command. Where it
/// falls, others ask for energy: the hand gives up what it has beyond 0.1 J, so that no force shrinks for that; what it
/// does not have is forgotten within some seconds. `SafeCommand::taken` tells what it gave up. After an interruption
/// and from another sender, supply and taken count anew.
///
/// A link that delays every command alike, by up to 150 ms for the whole round trip, does not make commands old: their
/// age is then counted from the delay that all commands of the last half second or more had (`link_delay`).
///
/// Force and torque are limited each by its own maximum, so that a device without torque still gives its force. At a
/// maximum, the axis of the wrench therefore moves. The power limit scales both alike.
///
/// Force and torques fade within seven periods and return within 200 ms. A rate of the descriptor below `max_force` in
/// seven periods makes both slower. Force and torque are never greater than this rate takes away within 15 periods:
/// the hand could draw energy from a greater one while it falls. Not thread-safe. Real-time safe: no allocation, no
/// lock, no system call.
class SafetyEnvelope {
 public:
  /// Ages up to `patience_periods` periods are normal. A period is that of the device or, if longer, that of the
  /// caller. Throws as `validate` does.
  explicit SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods = 3.0,
                          std::chrono::nanoseconds period_of_caller = std::chrono::nanoseconds(0));
  /// One that was moved from must not be used.
  SafetyEnvelope(SafetyEnvelope&&) noexcept;
  SafetyEnvelope& operator=(SafetyEnvelope&&) noexcept;
  ~SafetyEnvelope();

  /// The command for this period: `wanted`, which answers one of the last states, reduced as far as the descriptor and
  /// the reasons demand. `newest` is the newest state; `now` is a time on the caller's clock. Sequences and times do
  /// not change. Each call changes the force by at most its rate times the time since the last call, of which at most
  /// two periods count.
  SafeCommand limit(const GloveCommand& wanted, const GloveState& newest, std::chrono::nanoseconds now) noexcept;

  /// Whether the newest state is finite and plausible, and those of the last tenth of a second were. `limit` may be
  /// called afterwards with the same state.
  bool trusts(const GloveState& newest, std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: from now on the force fades to zero and stays there.
  void stop() noexcept;

  /// With force and torque as the rates lower them.
  const DeviceDescriptor& descriptor() const noexcept;

  /// The smallest age of a command in the last half second or longer: at the glove's end, the delay of the whole round
  /// trip. 0 in the first half second, and where it would be more than 150 ms, because that is a silence.
  std::chrono::nanoseconds link_delay() const noexcept;

 private:
  struct Stages;

  std::unique_ptr<Stages> stages_;
};

}  // namespace glissade::devices
