#pragma once

/// The hand-over from the simulation to the haptic thread: the visible pose of a part and the constraints around it, as
/// plain data of a fixed size.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// A constraint n·(v + w × r) ≥ bound on a displacement (v, w) of the part.
struct ConstraintRow {
  Eigen::Vector3d n;  ///< unit normal, from the obstacle to the part, world axes
  Eigen::Vector3d r;  ///< from the reference point to the contact point, world axes, metres
  double bound;       ///< metres; at most 0 where standing still is allowed

  /// The left side of the constraint.
  double velocity(const geometry::Displacement& d) const { return n.dot(d.v + d.w.cross(r)); }
};

/// Capacity of a contact set. At most six contacts of a part push at once; the other rows are the nearest contacts,
/// which may push soon. Finely tessellated faces that lie flush have more contacts; the excess is missing until the
/// next set.
inline constexpr std::size_t kMaxContactRows = 64;

/// The simulation's answer to one ghost pose.
struct ContactSet {
  std::int64_t sequence = 0;                                       ///< rises by one with every set; 0 before the first
  std::chrono::nanoseconds time{0};                                ///< time of the ghost pose that it answers
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();          ///< the visible part
  Eigen::Isometry3d X_WV_of_rows = Eigen::Isometry3d::Identity();  ///< the pose at which the rows were found
  double reach = 0.0;  ///< metres from that pose within which all constraints are known
  SlidingState state = SlidingState::kFree;
  std::int32_t pushing = 0;                                ///< contacts with a force
  std::int32_t dropped = 0;                                ///< contacts beyond the capacity
  std::int32_t row_count = 0;                              ///< rows in use
  std::array<ConstraintRow, kMaxContactRows> row_array{};  ///< pushing ones first, then the nearest

  std::span<const ConstraintRow> rows() const { return {row_array.data(), static_cast<std::size_t>(row_count)}; }
};

}  // namespace glissade::haptics
