#pragma once

/// The safety envelope is the only way from a wanted command to a device. It enforces every limit of the device's
/// descriptor. It lets the force fade whenever a state or a command is old, implausible or not permitted.

#include <chrono>
#include <memory>
#include <string>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>

namespace glissade::devices {

struct Calibration;

/// A command that a device may execute. Only `SafetyEnvelope` makes a `SafeCommand` that is not zero.
class GLISSADE_EXPORT SafeCommand {
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
  /// Energy (J) that force and torque may still give to the hand; see `SafetyEnvelope`.
  double energy() const noexcept { return energy_; }
  /// Energy (J) that the hand has given back since the last interruption because the server asked for it; see
  /// `GloveCommand::supply`.
  double taken() const noexcept { return taken_; }

 private:
  friend class SafetyEnvelope;
  friend class LcmGloveHost;

  /// The same command in the angles that the device reports (`calibration.h`), for a checked calibration.
  SafeCommand for_device(const Calibration& calibration) const noexcept;

  GloveCommand values_;
  LimitReasons reasons_;
  std::chrono::nanoseconds age_{0};
  std::chrono::nanoseconds state_age_{0};
  double energy_ = 0.0;
  double taken_ = 0.0;
};

/// The most serious reason in plain words, such as "no force: the glove's state is 14 ms old". Empty if there is no
/// reason. `age` is the age of the newest state if this state is old, else `SafeCommand::age`.
GLISSADE_EXPORT std::string to_text(const LimitReasons& reasons, std::chrono::nanoseconds age);
GLISSADE_EXPORT std::string to_text(const SafeCommand& command);

/// An envelope protects each device. A link has an envelope at the server's end and another at the glove's end. A
/// device in the server's process has a single envelope. The envelope remembers the last command and the last state, so
/// call `limit` once a period.
///
/// Ages count from the measurement times in the states. The clocks of glove and caller may differ. The message with the
/// shortest delay so far gives the difference of the clocks. The difference may grow by 0.2 ms/s. The difference is
/// determined anew in two cases: all states within a second are late although their times advance; or the glove's clock
/// goes back.
///
/// A passivity observer computes the work of force and torque on the hand from the measured motion and the commands
/// after all limits. A command counts from the delay of the device on until the next command acts, for at most max(10
/// ms, two periods). The available energy is 0.1 J at the start (for sampling errors), plus what the hand has put in,
/// minus what it has got back. Its maximum is about 0.25 m times the largest force. Joint torques do not count. The
/// wrench is a continuous function of energy and velocity. The wrench is never greater than the remaining energy
/// allows (derivation: docs/safety.md). At the end of a contact,
/// the energy falls to at most 0.1 J. If the energy is below 0.1 J, or below what the wanted wrench needs, it recovers:
/// at 0.3 W without a contact, and faster in a calm contact or after an interruption (conditions: docs/safety.md). All
/// recovery draws on a budget of 1 J, which refills at 0.25 W. For a glove that reports the delay of its link, only the
/// envelope at the glove's end limits the energy. With these rules, no delay and no error of the simulation can sustain
/// a fast oscillation that pushes both ways and gives more than 60 mW. A hand at rest feels no jump. Source of the
/// observer: Hannaford and Ryu, Time-domain passivity control of haptic interfaces, 2002. Source of wrenches that
/// shrink with the energy in a tank, and of tanks that exchange energy: Franken et al., Bilateral telemanipulation with
/// time delays: a two-layer approach combining passivity and transparency, 2011.
///
/// Bodies that move on their own may push the hand. `GloveCommand::supply` is the account of this energy. A rise of
/// `supply`, times the exerted share of the wanted wrench, counts as energy that the hand has put in, at a rate of at
/// most the device's largest power. A fall of `supply` is a request for energy. The hand gives up only energy above 0.1
/// J, and only the part that the wanted wrench does not need. So the force does not shrink. The rest of the request
/// decays with a time constant of 1 s. `SafeCommand::taken` is the energy given up. After an interruption or a change
/// of the sender, `taken` restarts at 0, and the difference from the earlier `supply` does not count.
///
/// The delay that three of four commands do not exceed (`link_delay`) is subtracted from the age of each command. So a
/// link delay does not make commands old if the whole round trip takes at most 150 ms. No command older than 150 ms
/// acts.
///
/// Force and torque have separate maxima, so that a device without torque still gives its force. However, the axis of
/// the wrench moves while one of the two is at its maximum. The power limit scales force and torque by the same factor.
///
/// Limits that the device holds by itself (`JointLimits`) tighten no faster than torques rise. When limits move against
/// a finger, their springs gain at most the sum of 20 mJ, the energy that other limits have given up, and 5 mW over
/// time (0.2 W while all fingers rest). Half-spaces (`HalfSpaces`) change no faster than force and torque. The energy
/// that their springs gain when they move against the hand is taken from the available energy.
///
/// Force, torques and limits fade within seven periods and return within 200 ms. Fade and return take longer if the
/// rate in the descriptor is lower than `max_force` in seven periods. Force and torque are kept so small that their
/// maximum rates bring them to zero within 15 periods, because the hand could draw energy from a force that falls too
/// slowly. Not thread-safe. Real-time safe: no allocation, no lock, no system call.
class GLISSADE_EXPORT SafetyEnvelope {
 public:
  /// States and commands older than `patience_periods` periods count as old. A period is the longer of the periods of
  /// device and caller. Throws what `validate` throws.
  explicit SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods = 3.0,
                          std::chrono::nanoseconds period_of_caller = std::chrono::nanoseconds(0));
  /// A moved-from envelope must not be used.
  SafetyEnvelope(SafetyEnvelope&&) noexcept;
  SafetyEnvelope& operator=(SafetyEnvelope&&) noexcept;
  ~SafetyEnvelope();

  /// The command for this period: `wanted`, reduced as far as the descriptor and the reasons demand. `wanted` answers
  /// one of the last states. `newest` is the newest state, and `now` is a time on the caller's clock. The result has
  /// the sequences and times of `wanted`. Each call changes the force by at most its rate times min(time since the last
  /// call, two periods).
  SafeCommand limit(const GloveCommand& wanted, const GloveState& newest, std::chrono::nanoseconds now) noexcept;

  /// Whether the newest state and the states of the last tenth of a second are finite and plausible. Afterwards,
  /// `limit` may be called with the same state.
  bool trusts(const GloveState& newest, std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: from now on the force fades to zero and stays there.
  void stop() noexcept;

  /// The descriptor, with the maxima of force and torque lowered to what their rates allow.
  const DeviceDescriptor& descriptor() const noexcept;

  /// An estimate of the upper quartile of the ages of new commands, which changes at a bounded rate. At the glove's
  /// end, it is the delay of the whole round trip. Ages above 150 ms count as silence. At least 1 ns, because 0 in a
  /// state has another meaning.
  std::chrono::nanoseconds link_delay() const noexcept;

 private:
  struct Stages;

  std::unique_ptr<Stages> stages_;
};

}  // namespace glissade::devices
