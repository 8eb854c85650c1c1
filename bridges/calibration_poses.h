#pragma once

/// The poses of a hand in which the sensors of a glove are calibrated.

#include <array>
#include <optional>
#include <string_view>

#include <glissade/hands/hand.h>

namespace glissade::bridges {

inline constexpr std::size_t kCalibrationPoses = 7;

/// A pose that a person can hold without an instrument.
struct CalibrationPose {
  std::string_view name;
  std::string_view guidance;  ///< a sentence for the wearer
  double tolerance;           ///< rad; allowed differences between wearers who show the pose
  /// In the order of `hands::kJointNames`, rad; no value for a joint that the pose does not determine.
  std::array<std::optional<double>, hands::kJoints> angles;
};

/// Flat, fist, the thumb to the tip of each finger, spread. In the poses of the thumb, the tips of a hand of usual size
/// touch (`calibration_poses_test`). The fist is that of a gloved hand, which closes less than a bare one.
const std::array<CalibrationPose, kCalibrationPoses>& calibration_poses();

/// The whole posture of a hand that shows a pose. Joints that the pose does not determine are straight.
hands::JointValues posture_of(const CalibrationPose& pose);

}  // namespace glissade::bridges
