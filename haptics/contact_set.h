#pragma once

/// What the simulation passes to the haptic thread (the 1 kHz loop that computes the force): the visible pose of a part
/// and the constraints of the contacts near that pose, as plain data of a fixed size.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// The force of a set is full up to kFullForce after the ghost pose that the set answers, and zero from kForceless on.
/// In between it fades smoothly.
inline constexpr std::chrono::milliseconds kFullForce{20};
inline constexpr std::chrono::milliseconds kForceless{100};

/// The constraint of one contact, n·(v + w × r) ≥ bound, on a displacement (v, w) of the part: v is the translation of
/// the part's reference point in metres, w the rotation vector about that point in radians.
struct ConstraintRow {
  Eigen::Vector3d n;  ///< unit normal, from the obstacle to the part, world axes
  Eigen::Vector3d r;  ///< from the reference point to the contact point, world axes, metres
  double bound;       ///< metres; at most 0 if the constraint allows standing still
  double range = std::numeric_limits<double>::infinity();  ///< metres: `Contact::range`
  double approach = 0.0;  ///< m/s: `Contact::approach`, by which the bound grows with the age of the set

  /// The left side of the constraint: the motion of the contact point along n, in metres.
  double velocity(const geometry::Displacement& d) const { return n.dot(d.v + d.w.cross(r)); }
};

/// Maximum number of rows, i.e. constraints, in a contact set. Without friction, at most six contacts of a single part
/// push at once; the other rows are the nearest contacts, which may push soon. Finely tessellated faces that lie flush
/// may have more than 64 contacts; the set then omits the farthest contacts.
inline constexpr std::size_t kMaxContactRows = 64;

/// The simulation's answer to one pose of the ghost, i.e. to a pose that the part would have if nothing were in the
/// way.
struct ContactSet {
  std::int64_t sequence = 0;                               ///< 1, 2, 3, … in the order of the sets; 0: no set yet
  std::chrono::nanoseconds time{0};                        ///< time of the ghost pose that the set answers
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part, as displayed
  Eigen::Isometry3d X_WV_of_rows = Eigen::Isometry3d::Identity();  ///< the pose at which the rows were found
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();          ///< the ghost that the set answers
  /// The target in the frame of the ghost. Not the identity where the hand holds the part at an offset, or where the
  /// metaphor wants another pose than the ghost's.
  Eigen::Isometry3d X_GT = Eigen::Isometry3d::Identity();
  /// Metres: with the part at X_WV_of_rows, the simulation found every contact with a gap smaller than this. The set
  /// has a row for each contact found, except for the `dropped` ones. For the paper's method see
  /// `SlidingResult::reach`.
  double reach = 0.0;
  SlidingState state = SlidingState::kFree;
  std::int32_t pushing = 0;                                ///< number of contacts that push, i.e. have a positive force
  std::int32_t dropped = 0;                                ///< contacts without a row, beyond kMaxContactRows
  std::int32_t row_count = 0;                              ///< rows in use
  std::array<ConstraintRow, kMaxContactRows> row_array{};  ///< first the pushing contacts, then the others
  /// For each row: friction on the part divided by the normal force, in world axes; perpendicular to the normal, and no
  /// longer than the coefficient of friction. Zero for contacts that do not push.
  std::array<Eigen::Vector3d, kMaxContactRows> friction_ratio_W{};

  std::span<const ConstraintRow> rows() const { return {row_array.data(), static_cast<std::size_t>(row_count)}; }
};

}  // namespace glissade::haptics
