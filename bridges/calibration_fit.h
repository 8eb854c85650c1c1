#pragma once

/// Computes a calibration from the angles that a glove reports in the poses of `calibration_poses.h`.

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/bridges/calibration_poses.h>
#include <glissade/devices/calibration.h>
#include <glissade/devices/glove_device.h>

namespace glissade::bridges {

/// The data do not suffice for a calibration. `what()` says what is wrong with the data, and what helps.
class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the device reported while the wearer held a pose: medians, and extremes of the angles.
struct HeldPose {
  hands::JointValues angles{};
  hands::JointValues least{};
  hands::JointValues most{};
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
};

/// Computes the held pose from the states of one hold. The hand was still if the medians of the first, second and last
/// third of the hold agree. So noise and tremor do not count as motion. Throws CalibrationError if the hand moved, or
/// for too few states.
HeldPose held_pose(std::span<const devices::GloveState> states, const devices::DeviceDescriptor& descriptor);

struct JointFits {
  std::array<std::optional<devices::JointCalibration>, hands::kJoints> joints{};
  std::vector<std::string> remarks;  ///< sentences about poses that do not count for a joint
};

/// Fits gain and offset of each joint by least squares, over the poses that are within their tolerances of the line of
/// least absolute errors. So a pose that the wearer shows differently does not matter. A joint whose angle is the same
/// in all poses gets an offset only. A joint that the device does not measure, i.e. whose angle never changed, and the
/// joints of `without` get no calibration. Throws CalibrationError with a sentence for each joint whose data are bad.
JointFits fit_joints(const std::array<HeldPose, kCalibrationPoses>& poses, const std::vector<std::string>& without);

}  // namespace glissade::bridges
