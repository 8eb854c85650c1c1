#pragma once

/// The numbers of the haptic loop that are chosen, not derived: what each is for, and where it is not plain, what a
/// larger or smaller value would cost. The ages of contact sets are in `contact_set.h`. docs/safety.md has the
/// reasoning.

#include <numbers>

namespace glissade::haptics {

struct LoopSettings {
  // Coupling:
  double damping_time_s = 5e-3;       ///< damping per stiffness. More: a push that ends late. Less: a hand that swings
  double follows_link_s = 0.1;        ///< time constant of delay and lever. Less: a state that is wrong moves the force
  double longest_link_delay_s = 1.0;  ///< a longer one counts as this
  double fastest_lever_m_per_s = 10.0;

  // States and hands:
  double patience_periods = 3.0;  ///< age of a state from which the force fades. More: force without valid data
  int grip_states = 3;            ///< so many closed states take a part: one may be an error
  double headroom = 1.05;         ///< of the largest force: what contacts may demand, so that the envelope tells of it
  double joins_s = 0.2;           ///< in which a hand that takes a held part gets its share of it
  double leaves_s = 0.05;         ///< in which a hand without valid states loses this share
  double palm_rad_per_s = 30.0;   ///< of the wrist joints. More: a wrong angle flings the part
  double lost_after_s = 0.1;      ///< without a state, a hand with fingers is lost

  // Catching up after a late call of the simulation:
  double longest_catch_up_ms = 250.0;
  double step_ms = 5.0;     ///< a longer time is divided. More: the part takes a shorter way than the hand
  double most_steps = 5.0;  ///< more: a late call makes the next one later

  // Contact force:
  double fastest_ghost_m_per_s = 2.0;  ///< motion beyond is no reason for a faster change of the force
  double return_s = 0.2;               ///< of the force of contacts that were old
  /// Beyond the range of a contact its plane stands for what follows, wholly up to `known_m` and no more from
  /// `unknown_m` on. Longer: a face pushes beyond its edge. Shorter: a part that lags behind the hand loses its force.
  double known_m = 3e-3;
  double unknown_m = 9e-3;
  double fastest_part_m_per_s = 10.0;  ///< a faster part was taken elsewhere: it pushes nobody

  // Energy of several hands (docs/safety.md):
  double most_lift_J = 1.0;  ///< for hands that sank while their force was withheld. Less: they stay sunk
  double lift_W = 0.1;       ///< refill of this energy
  double forgotten_s = 1.0;  ///< time constant of energy in the pool that nobody takes

  // Finger springs:
  double full_torque_rad = 0.8 * std::numbers::pi / 180.0;  ///< the largest torque on the shortest way
  double short_arm_m = 2e-3;              ///< a contact at a shorter arm counts less: its angle is not sharp
  double fastest_finger_rad_per_s = 6.0;  ///< motion beyond is no reason for a faster change of the torque

  // Load of the part on the fingers:
  double load_share = 0.5;        ///< of the largest torque of a joint. The rest is for the springs
  double load_follows_s = 30e-3;  ///< from zero to the largest torque. Shorter: the load feeds a rattle
  double load_fades_s = 2e-3;     ///< once a segment is off the part
  double load_full_m = 0.2e-3;    ///< distance of the glove's segment from the part up to which the load is whole
  double load_none_m = 1.2e-3;    ///< and from which there is none
  double load_start_J = 20e-3;
  double load_most_J = 40e-3;   ///< more: a longer rattle until the load fades
  double load_fades_J = 10e-3;  ///< below this, the load fades
  double load_refill_W = 5e-3;
  double load_silence_s = 0.1;           ///< between states; what the fingers did in a longer one is not known
  double load_fastest_rad_per_s = 30.0;  ///< a faster finger is an error of its sensor
  double small_forces = 0.05;            ///< weight of small forces against forces that cancel each other
};

inline constexpr LoopSettings kLoop;

}  // namespace glissade::haptics
