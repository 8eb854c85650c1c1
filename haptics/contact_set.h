#pragma once

/// The plain data of fixed size that the haptic thread (the 1 kHz loop that computes the forces) and the simulation
/// exchange. The haptic thread passes the ghosts of all parts and the postures of all hands to the simulation. The
/// simulation answers with the visible poses and the constraints of nearby contacts.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/projection.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/hands/hand.h>

namespace glissade::haptics {

/// Ages of a contact set, counted from the ghost poses from which the set was computed. The force of the set is full up
/// to kFullForce, then fades smoothly, and is zero from kForceless on.
inline constexpr std::chrono::milliseconds kFullForce{20};
inline constexpr std::chrono::milliseconds kForceless{100};

/// The constraint of a contact and its range. The other body is an obstacle or a part that another hand leads.
struct ContactRow : contact::CoupledRow {
  double range = std::numeric_limits<double>::infinity();  ///< metres; see `Contact::range`
  double approach = 0.0;  ///< m/s, see `Contact::approach`; `bound` grows at this rate with the set's age
  bool pushes = false;    ///< the contact has a positive force
  /// Friction on the part divided by the normal force, in world axes. This vector is perpendicular to the normal, and
  /// its norm is at most the coefficient of friction. It is zero for contacts that do not push.
  Eigen::Vector3d friction_ratio_W = Eigen::Vector3d::Zero();
};

/// Maximum number of rows of one part in a contact set. Without friction, at most six contacts of a single part push at
/// once. The other rows are the nearest contacts, which may push soon. If flush faces with a fine tessellation have
/// more than 64 contacts, the set omits the farthest contacts.
inline constexpr std::size_t kMaxContactRows = 64;

/// The simulation's answer for one part.
struct PartAnswer {
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();        ///< reference point of this hold (the compliance point)
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part, as displayed
  Eigen::Isometry3d X_WV_of_rows = Eigen::Isometry3d::Identity();  ///< the pose at which the rows were found
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();          ///< the ghost from which the set was computed
  /// The target in the frame of the ghost. The target differs from the identity if the hand holds the part at an
  /// offset, or if the metaphor (`contact::Metaphor`) wants another pose than that of the ghost.
  Eigen::Isometry3d X_GT = Eigen::Isometry3d::Identity();
  /// Metres. With the part at X_WV_of_rows, the simulation found every contact whose gap is smaller than `reach`. The
  /// set has a row for each contact found, except for the `dropped` contacts.
  double reach = 0.0;
  contact::SlidingState state = contact::SlidingState::kFree;
  std::int32_t pushing = 0;  ///< number of contacts with a positive force
  std::int32_t dropped = 0;  ///< number of contacts beyond kMaxContactRows, which have no row
  std::int64_t hold = 0;     ///< `GhostOfPart::hold` of the ghost from which the set was computed
};

/// A contact of a segment of a hand with fingers. If the joints of the hand turn by d (rad, one for each joint), the
/// gap grows by rates · d, to first order.
struct FingerRow {
  hands::JointValues rates{};                     ///< m/rad
  double gap = 0.0;                               ///< distance at the visible hand minus the margin, at least 0; metres
  std::int32_t part = -1;                         ///< number of the part that the segment touches; −1: another body
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, from the touched body to the segment
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< metres: the contact point of the segment
};

/// Maximum number of rows of one hand in a contact set. On a finely tessellated object a hand may have more contacts.
/// The set then has three kinds of contacts: for each joint, the contact that pushes it back the farthest; for each
/// segment and object, the deepest contact; and the deepest of the other contacts. So no torque depends on omitted
/// contacts.
inline constexpr std::size_t kMaxFingerRows = 32;

/// The simulation's answer for one hand with fingers: the visible hand, and the part that this hand is to hold.
struct HandAnswer {
  hands::VisibleHand visible;
  std::int32_t part = -1;      ///< number of the part that the hand is to hold; −1: none
  std::int64_t decision = 0;   ///< increases whenever the simulation decides on another part
  std::int32_t row_count = 0;  ///< rows in use
  std::array<FingerRow, kMaxFingerRows> row_array{};

  std::span<const FingerRow> rows() const { return {row_array.data(), static_cast<std::size_t>(row_count)}; }
};

/// The simulation's answer to one pose of each ghost. The ghost is the pose that the part would have if nothing were in
/// the way. Only parts that hands lead have rows.
struct ContactSet {
  std::int64_t sequence = 0;         ///< 1, 2, 3, … in the order of the sets; 0: no set yet
  std::chrono::nanoseconds time{0};  ///< time of the ghost poses from which the set was computed
  std::int32_t part_count = 1;
  std::array<PartAnswer, contact::kMaxParts> parts{};
  std::int32_t row_count = 0;  ///< rows in use
  /// The rows are grouped by part. The rows of a part begin with the pushing contacts. The others follow, the nearest
  /// first.
  std::array<ContactRow, contact::kMaxParts * kMaxContactRows> row_array{};
  std::array<HandAnswer, hands::kMaxHands> hands{};  ///< only hands with fingers
  // For display.
  std::int32_t patch_count = 0;
  std::int32_t patches_left_out = 0;  ///< number of patches beyond kHapticPatches
  std::array<devices::HapticPatch, devices::kHapticPatches> patches{};

  std::span<const ContactRow> rows() const { return {row_array.data(), static_cast<std::size_t>(row_count)}; }
};

/// The state of one part that the haptic thread passes to the simulation. The simulation sees only the newest poses,
/// but the counts `hold` and `release` also show it all grasps and releases in between.
struct GhostOfPart {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  bool is_held = false;
  std::int64_t hold = 0;     ///< increases whenever a hand takes hold or lets go; the ghost is then set anew
  std::int64_t release = 0;  ///< value of `hold` when the last hand let go
};

/// The state of one hand with fingers that the haptic thread passes to the simulation.
struct GhostOfHand {
  bool is_tracked = false;  ///< the newest pose and angles arrived less than 0.1 s ago
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  hands::JointValues angles{};  ///< rad
  std::int32_t part = -1;       ///< number of the part that the hand holds; −1: none
};

/// All parts and hands at one time of the haptic clock.
struct Ghosts {
  std::chrono::nanoseconds time{0};
  std::array<GhostOfPart, contact::kMaxParts> parts{};
  std::array<GhostOfHand, hands::kMaxHands> hands{};  ///< only hands with fingers
};

/// The state for viewers.
GLISSADE_EXPORT devices::PartState part_state_of(contact::SlidingState state) noexcept;

}  // namespace glissade::haptics
