#pragma once

/// The state after one haptic tick, i.e. one cycle of the 1 kHz loop that computes the force, as viewers and recorders
/// see it. The part is the object in the hand. Frames: W world; V visible part, the pose at which the part is shown;
/// G ghost, where the part would be if nothing were in the way.

#include <chrono>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/devices/safety_envelope.h>

namespace glissade::devices {

/// State of the part in the simulation. Messages carry its number. The numbers keep their meaning in all versions. The
/// target is the pose to which the hand pulls the part. A contact pushes while it exerts a force.
enum class PartState : std::int32_t {
  kUnknown = 0,     ///< the state was not reported, or this program has no state with that number
  kReleased = 1,    ///< no hand holds the part; it stands still
  kFree = 2,        ///< the part is at its target
  kSliding = 3,     ///< contacts push, and the part moves along the contacts
  kResting = 4,     ///< contacts push, and the part stands still
  kCatchingUp = 5,  ///< no contact pushes, but the part is not at its target yet
};

/// Number of part states; their values run from 0 to kPartStates − 1.
inline constexpr std::int32_t kPartStates = 6;

/// The name of a state, such as "sliding"; "unknown" for a value that is none of the above.
std::string_view name_of(PartState state);

/// The state with this number; kUnknown for any other number.
PartState part_state_from_number(std::int32_t number) noexcept;

/// One haptic tick. The contact set is the newest answer of the simulation to a pose of the ghost: the pose X_WV and
/// the contacts of the part.
struct HapticState {
  std::int64_t sequence = 0;         ///< ≥ 0, increases with every tick
  std::chrono::nanoseconds time{0};  ///< time of the tick, on the haptic loop's clock
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  Eigen::Vector3d force_on_hand_W = Eigen::Vector3d::Zero();     ///< N
  Eigen::Vector3d torque_on_hand_V_W = Eigen::Vector3d::Zero();  ///< Nm, about the origin of V, in world axes
  PartState part_state = PartState::kUnknown;
  std::int32_t contact_count = 0;               ///< contacts that push
  std::chrono::nanoseconds contact_set_age{0};  ///< time since that ghost pose; 0 before the first set
  bool is_in_contact = false;                   ///< at least one contact pushes
  bool is_contact_set_late = false;             ///< the contact set was older than 5 ms
  /// The share of the contacts' force that is exerted: less than 1 where they are old, or where the hand has left them
  /// and the part lags behind, and while the force returns from there.
  double contact_share = 1.0;
  bool are_contacts_unsolved = false;       ///< the contacts had no solution, so their force went towards zero
  LimitReasons reasons;                     ///< why the device got less than the contacts demand
  std::chrono::nanoseconds state_age{0};    ///< time since the measurement of the glove's state
  LimitReasons glove_reasons;               ///< `GloveState::limits`
  std::chrono::nanoseconds command_age{0};  ///< `GloveState::command_age`
  double energy = 0.0;                      ///< `SafeCommand::energy`, J
  double glove_energy = 0.0;                ///< `GloveState::energy`
};

}  // namespace glissade::devices
