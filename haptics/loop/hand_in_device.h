#pragma once

/// What the kernel remembers of a hand from tick to tick.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/haptics/coupling.h>

#include "loop/contact_force.h"
#include "loop/fingers_of_hand.h"
#include "loop/loop_settings.h"

namespace glissade::haptics {

/// A hand with its device.
struct HandInDevice {
  std::array<Coupling, contact::kMaxParts> couplings{};  // one for each part that can be held
  Coupling present{};
  double link_delay_s = 0.0;
  double lever_m = 0.0;  // from the hand to the reference point, smoothed
  double of_link = 0.0;  // 1 while the part is near a part in another hand, smoothed
  ContactForce contacts;
  devices::SafetyEnvelope envelope;
  bool is_fading = false;                            // in the last tick
  std::optional<std::size_t> given;                  // the part for its first grip
  std::optional<std::size_t> last_part;              // that it held in the last tick
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  // the reference point in the last tick
  Eigen::Vector3d p_Wref = Eigen::Vector3d::Zero();  // about which the contacts' wrench was in the last tick
  std::optional<std::int64_t> grip;                  // that the hand has followed
  std::int64_t told_grip = 0;                        // of the last states, so many in a row
  int told_states = 0;
  std::int64_t told_sequence = -1;
  std::int64_t sequence = 0;
  double owed = 0.0;     // J: work of the hand against force that was withheld, as far as it has not been lifted again
  double lifts = 0.0;    // J, for which the hand may be lifted; a server that begins anew has earned none
  double taken = 0.0;    // `SafeCommand::taken` of the last command
  contact::Wrench pull;  // of other hands in the last command
  contact::Wrench solved;           // of the contacts when they last had a solution
  devices::HalfSpaces half_spaces;  // wanted in the last tick
  std::optional<FingersOfHand> fingers;

  /// A hand that sinks while the force of its contacts is withheld is lifted when it returns, as if it had sunk against
  /// the force. From the work against the withheld and the exerted force in this tick, the energy to lift it with.
  double lift(double against_withheld, double against_exerted, double dt) noexcept {
    owed = std::max(0.0, owed + against_withheld);
    lifts = std::min(kLoop.most_lift_J, lifts + kLoop.lift_W * dt);
    const double lifted = std::clamp(-against_exerted, 0.0, std::min(owed, lifts));
    owed -= lifted;
    lifts -= lifted;
    return lifted;
  }

  /// Adapts the present coupling to the delay of the link, to the distance of the part's reference point, and to
  /// whether the part meets one in another hand. Returns the share of the coupling's force that is left: force and
  /// torque shrink alike, so that the wrench stays a sum of contact normals. It applies to what is wanted from now on:
  /// a force that is there falls from where it is.
  double soften(const Coupling& coupling, std::chrono::nanoseconds period, std::chrono::nanoseconds link_delay,
                double distance, bool meets_led_part, bool is_new, double dt) noexcept {
    const double delay_s =
        std::clamp(std::chrono::duration<double>(link_delay).count(), 0.0, kLoop.longest_link_delay_s);
    link_delay_s += std::min(1.0, dt / kLoop.follows_link_s) * (delay_s - link_delay_s);
    if (std::isfinite(distance)) {
      // A state that is wrong for a moment moves it little.
      const double most = is_new ? distance + lever_m : kLoop.fastest_lever_m_per_s * dt;
      lever_m +=
          std::clamp((is_new ? 1.0 : std::min(1.0, dt / kLoop.follows_link_s)) * (distance - lever_m), -most, most);
    }
    of_link += std::min(1.0, dt / kLoop.follows_link_s) * ((meets_led_part ? 1.0 : 0.0) - of_link);
    const auto delay =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(link_delay_s));
    present = coupling_within_limits(envelope.descriptor(), coupling.stiffness, period, delay, lever_m, of_link);
    if (fingers) fingers->set_link_delay(delay);
    return std::min(present.stiffness.translational / coupling.stiffness.translational,
                    present.stiffness.rotational / coupling.stiffness.rotational);
  }
};

}  // namespace glissade::haptics
