#pragma once

/// The calibration of a glove for one user: from the joint angles and the pose that the device reports to those of the
/// hand. `LcmGloveHost` applies it, so that servers, recordings and the envelope only get calibrated values. Frames:
/// W world, H hand root, T what the device or its tracker reports as the hand root.

#include <array>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/hands/hand.h>

namespace glissade::devices {

/// The allowed gains. A sensor outside this range does not measure its joint.
inline constexpr double kLeastGain = 0.2;
inline constexpr double kGreatestGain = 5.0;

/// The sensor of one joint. Angle of the joint = gain × reported angle + offset, in rad.
struct JointCalibration {
  double gain = 1.0;  ///< from kLeastGain to kGreatestGain
  double offset = 0.0;
  /// The reported angles of the poses in which the sensor was calibrated, and the root mean square of the fit's errors.
  double reported_least = 0.0;
  double reported_most = 0.0;
  double residual = 0.0;

  bool operator==(const JointCalibration&) const = default;
  double angle(double reported) const noexcept { return gain * reported + offset; }
  double reported(double angle) const noexcept { return (angle - offset) / gain; }
};

struct GLISSADE_EXPORT Calibration {
  std::string user;
  std::string device;  ///< `DeviceDescriptor::name`
  hands::HandSide side = hands::HandSide::kUnknown;
  /// In the order of `hands::kJointNames`; a joint without a value stays as the device reports it.
  std::array<std::optional<JointCalibration>, hands::kJoints> joints{};
  Eigen::Isometry3d X_TH = Eigen::Isometry3d::Identity();  ///< where a tracker is worn

  /// Turns reported angles, pose and velocities into those of the hand. Real-time safe.
  void apply(GloveState& state) const noexcept;

  /// Turns limits of the hand's joints into the limits that the device must hold in its own angles. Torques stay the
  /// same. Real-time safe.
  JointLimits to_device(const JointLimits& limits) const noexcept;

  /// The descriptor of the calibrated device, of the descriptor of the bare device.
  DeviceDescriptor calibrated(const DeviceDescriptor& descriptor) const;
};

/// Throws std::invalid_argument if the calibration is for another device or side, or has gains out of range or numbers
/// that are not finite. Also throws for a device that exerts
/// a force or torque on the hand and has an `X_TH`: such a device must report the place where it exerts them.
GLISSADE_EXPORT void check_calibration(const Calibration& calibration, const DeviceDescriptor& descriptor,
                                       hands::HandSide side);

/// Reads a calibration (YAML, see docs/devices.md). Throws std::invalid_argument, naming file, line and key.
GLISSADE_EXPORT Calibration read_calibration(const std::string& path);
/// `source` stands for the file's name in messages.
GLISSADE_EXPORT Calibration parse_calibration(const std::string& text, const std::string& source);

/// The text of a file that reads back as the same calibration.
GLISSADE_EXPORT std::string text_of(const Calibration& calibration);

}  // namespace glissade::devices
