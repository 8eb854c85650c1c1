#pragma once

/// One haptic tick as viewers and recorders see it. Frames: W world; V visible part; G ghost, where the part would be
/// if nothing were in the way.

#include <chrono>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::devices {

/// State of the part in the simulation, as sent over the wire. The numbers never change their meaning. The target is
/// the pose that the hand wants of the part.
enum class PartState : std::int32_t {
  kUnknown = 0,     ///< the state was not reported, or its number is not known to this program
  kReleased = 1,    ///< no hand holds the part; it stands still
  kFree = 2,        ///< the part is at its target
  kSliding = 3,     ///< contacts push, and the part moves along the contacts
  kResting = 4,     ///< contacts push, and the part stands still
  kCatchingUp = 5,  ///< no contact pushes, but the part is not at its target yet
};

/// Number of part states; their values run from 0 to kPartStates − 1.
inline constexpr std::int32_t kPartStates = 6;

/// The name of a state, such as "sliding"; "unknown" for any other value.
std::string_view name_of(PartState state);

/// The state with this number; kUnknown for any other number.
PartState part_state_from_number(std::int32_t number) noexcept;

struct HapticState {
  std::int64_t sequence = 0;
  std::chrono::nanoseconds time{0};
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  Eigen::Vector3d force_on_hand_W = Eigen::Vector3d::Zero();     ///< N
  Eigen::Vector3d torque_on_hand_V_W = Eigen::Vector3d::Zero();  ///< Nm, about the origin of V, in world axes
  PartState part_state = PartState::kUnknown;
  std::int32_t contact_count = 0;
  std::chrono::nanoseconds contact_set_age{0};
  bool is_in_contact = false;
  bool is_force_limited = false;     ///< the wrench was reduced to the device's limits
  bool is_contact_set_late = false;  ///< the contact set was older than 5 ms
  bool has_no_device = false;        ///< the newest glove state was too old, so the device got no force
};

}  // namespace glissade::devices
