#pragma once

/// What a simulation of sliding contact answers, whatever its method.

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/contact.h>

namespace glissade::haptics {

enum class SlidingState : std::uint8_t {
  kReleased,    ///< nobody holds the part, which stands still
  kFree,        ///< the visible part is where the metaphor wants it
  kSliding,     ///< contacts push, the part moves along them
  kResting,     ///< contacts push, the part stands still
  kCatchingUp,  ///< nothing pushes, but the part is not there yet
};

std::string_view name_of(SlidingState state);

/// What one call of `advance` led to.
struct SlidingResult {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< the ghost
  Eigen::Isometry3d X_WT =
      Eigen::Isometry3d::Identity();  ///< where the metaphor wants the part, see `wanted_pose` and `grasp`
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle and the pose they were found at; those with a force push. Of several parts they are
  /// carried along with the last step of both sides, and the pose is X_WV.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  double reach = 0.0;  ///< metres from that pose within which contacts were looked for
  int pushing = 0;     ///< number of contacts with a force
  int cycles = 0;
};

}  // namespace glissade::haptics
