#pragma once

/// The numbers of the envelope's stages that are chosen, not derived: what each is for, and where it is not plain, what
/// a larger or smaller value would cost. docs/safety.md has the reasoning.

#include <chrono>
#include <cstdint>

namespace glissade::devices {

struct EnvelopeSettings {
  // Fade and return (promises 3 and 4):
  /// Periods from the largest force to zero, also the default rate. More: force without valid data. Fewer: a blow.
  double fade_periods = 7.0;
  /// From zero to the whole force, s. Longer: a pause that the hand feels. Shorter: a push.
  double return_s = 0.2;
  /// No force exceeds what the rates bring to zero in so many periods. More: energy from a force that falls late.
  double longest_fall_periods = 15.0;
  /// So long a device acts on its last command. What the maker of a device must do, see docs/safety.md.
  std::chrono::milliseconds exerted_without_command{10};

  // Mean force:
  double mean_time_s = 10.0;
  double soft_mean = 0.9;     ///< share of the largest mean from which the force is reduced at the latest
  double mean_change = 8e-3;  ///< largest change by it in a period, as a share of the force (promise 11)

  // Link delay:
  double delay_follows_s = 0.25;  ///< time constant. Shorter: the force of a resting hand follows the scatter of ages
  double lag_change = 8e-3;       ///< in a period at most, as a share of the lag: so much a force may change by it
  double finds_delay =
      4.0;  ///< times as fast until the first delay is found: till then, commands seem too old for a force
  std::chrono::milliseconds longest_delay{150};  ///< more is a silence, and no older command acts

  // States:
  std::chrono::milliseconds distrust{100};        ///< no force for so long after an implausible state
  std::chrono::milliseconds late_for_good{1000};  ///< after which a later clock is taken as set
  std::int64_t drift_share = 5000;                ///< clocks may drift apart by one part in so many
  double jump_tolerance_m = 1e-3;                 ///< more than noise of a tracker between two states
  double turn_tolerance_rad = 1e-2;
  double speed_mismatch = 0.5;    ///< of `max_speed`: by which way and velocity may disagree
  double longest_repeat_s = 0.1;  ///< of a pose that repeats while the hand may move
  double much_faster = 5.0;       ///< times `max_speed`: not a hand any more, but an error of the tracker

  // Energy (promises 9 and 11). At the start, and outside contacts:
  double start_energy_J = 0.1;  ///< less: a tracker's noise takes the force of a light touch
  /// The largest account is that of the largest force on this way, m. Longer: an old push may be given back later.
  double most_energy_m = 0.25;
  /// The share of a wrench that is given pays for so long a way before its fall: a force begins without a jump. Longer:
  /// a hand that moves out of a contact is braked.
  double spare_m = 1e-3;
  double leaving_m_per_s2 =
      50.0;                     ///< m/s², of a hand that leaves: its way within delay and fall is paid in advance, too
  double lever_m = 0.1;         ///< rotations count by the way at this distance, here and for strokes
  double ahead_periods = 10.0;  ///< for which the power is paid in advance: longer than a fade
  double held_power = 3.0;      ///< times what is looked ahead: a brake that follows the velocity shakes light hands
  double most_refill_J = 1.0;   ///< allowance for returns and calm contacts. Less: a soft arm is not lifted
  double refill_W = 0.25;       ///< of this allowance; the rest of 0.3 W is for ways that are not measured
  double recovery_W = 0.3;      ///< in free space
  double calm_refill_W = 0.6;   ///< in a calm contact: 90 % of the force after 2 s of rest
  std::chrono::milliseconds return_is_free{500};  ///< after a return: the refill lifts the hand at once
  double most_debt_J = 0.3;                       ///< left of a jump of the tracker
  std::chrono::seconds forgives_again{30};        ///< a tracker that stands still again and again costs energy

  // Strokes, i.e. whether a contact is calm:
  double usual_resolution_m = 30e-6;  ///< of a device that does not tell
  double play_per_resolution = 4.0;   ///< noise of this standard deviation hardly ever leaves the play
  double forget_s = 0.5;              ///< time constant of the memory of strokes
  double most_stirred_J = 0.01;       ///< to and fro, twice the work from which a contact is not calm

  // Limits that the device holds:
  double limits_start_J = 20e-3;  ///< for springs that gain energy as limits move. Less: a late limit stays soft
  /// The largest account is that of the largest torque on this way, rad: what five pressed springs store, and lose in
  /// an interruption. More: a longer rattle until the limits stand still. Less: fingers that press lose their limits.
  double limits_most_rad = 0.5;
  double limits_refill_W = 5e-3;
  double limits_rest_refill_W = 0.2;  ///< while all fingers rest. Less: limits return late after an interruption
  double resting_rad_per_s = 0.5;     ///< a slower finger rests
  double resting_m_per_s = 0.03;      ///< a slower hand rests (promise 11)
  double rate_averaged_s = 0.03;      ///< over which a rate is averaged: steps of a sensor are no motion
  double rested_s = 0.2;              ///< after so long. Less: a finger that swings rests at each end of its stroke
  double limits_last_periods = 3.0;   ///< of the device without a command, then it opens them. Fewer: lost packets open

  // Supply:
  double forgotten_s = 1.0;  ///< time constant in which an unmet request lapses
};

inline constexpr EnvelopeSettings kEnvelope;

}  // namespace glissade::devices
