#pragma once

/// One haptic tick as viewers and recorders see it. Frames: W world, G ghost, V visible part.

#include <chrono>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::devices {

/// State of the part in the simulation, as sent over the wire: the numbers never change their meaning.
enum class PartState : std::int32_t {
  kUnknown = 0,     ///< not reported, or not known to this program
  kReleased = 1,    ///< nobody holds the part
  kFree = 2,        ///< the part is at its target
  kSliding = 3,     ///< contacts push, the part moves along them
  kResting = 4,     ///< contacts push, the part stands still
  kCatchingUp = 5,  ///< nothing pushes, but the part is not at its target yet
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
  bool is_contact_set_late = false;  ///< the simulation had not renewed the contact set in time
  bool has_no_device = false;        ///< no fresh glove state
};

}  // namespace glissade::devices
