#pragma once

/// One haptic tick as viewers and recorders see it. Frames: W world, G ghost, V visible part.

#include <chrono>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::devices {

/// What the simulation does with the part, as it is told on the wire: these numbers never change their meaning.
enum class PartState : std::int32_t {
  kUnknown = 0,     ///< none is told, or one that this program does not know
  kReleased = 1,    ///< nobody holds the part
  kFree = 2,        ///< it is where the hand wants it
  kSliding = 3,     ///< contacts push, it moves along them
  kResting = 4,     ///< contacts push, it stands still
  kCatchingUp = 5,  ///< nothing pushes, but it is not there yet
};

/// As many as there are; their numbers are 0 to this less one.
inline constexpr std::int32_t kPartStates = 6;

/// "sliding", say; "unknown" for anything that is no state.
std::string_view name_of(PartState state);

/// The state with this number; kUnknown where there is none.
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
  bool is_force_limited = false;     ///< the wrench was cut to the device's limits
  bool is_contact_set_late = false;  ///< the simulation had not renewed the contact set in time
  bool has_no_device = false;        ///< no fresh glove state
};

}  // namespace glissade::devices
