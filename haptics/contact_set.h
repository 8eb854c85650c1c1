#pragma once

/// What the simulation hands to the haptic thread: the visible pose and the constraints around it, in a fixed size.

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/projection.h>
#include <glissade/haptics/sliding.h>

namespace glissade::haptics {

/// At most six contacts push at once; the others are the nearest of those that may soon. On finely cut faces that lie
/// flush there are more than this, and those left out are missing until the next set.
inline constexpr std::size_t kMaxContactRows = 64;

/// The answer to one ghost pose.
struct ContactSet {
  std::int64_t sequence = 0;                                       ///< rises by one with every set; 0 means none yet
  std::chrono::nanoseconds time{0};                                ///< of the ghost pose it answers
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();          ///< the visible part
  Eigen::Isometry3d X_WV_of_rows = Eigen::Isometry3d::Identity();  ///< the part when the rows were found
  double reach = 0.0;  ///< metres: the rows tell of everything this near to that pose
  SlidingState state = SlidingState::kFree;
  std::int32_t pushing = 0;  ///< contacts with a force
  std::int32_t dropped = 0;  ///< contacts there was no room for
  std::int32_t row_count = 0;
  std::array<ConstraintRow, kMaxContactRows> row_array{};  ///< pushing ones first, then the nearest

  std::span<const ConstraintRow> rows() const { return {row_array.data(), static_cast<std::size_t>(row_count)}; }
};

/// Gathers the newest result of `sliding`, as the answer to the ghost pose of `time`.
/// `scratch` is reused between calls. Cost O(contacts).
ContactSet make_contact_set(const Sliding& sliding, std::int64_t sequence, std::chrono::nanoseconds time,
                            std::vector<std::int32_t>& scratch);

}  // namespace glissade::haptics
