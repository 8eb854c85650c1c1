#pragma once

/// The calibration of a glove for one user. It turns the joint angles and the pose that the device reports into those
/// of the hand. `LcmGloveHost` applies it, so servers, recordings and the envelope get calibrated values only. Frames:
/// W world; H hand root; T the frame that the device or its tracker reports as the hand root.

#include <array>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/hands/hand.h>

namespace glissade::devices {

/// The allowed gains. A sensor with a gain outside this range does not measure its joint.
inline constexpr double kLeastGain = 0.2;
inline constexpr double kGreatestGain = 5.0;

/// The calibration of one joint's sensor: joint angle = gain × reported angle + offset, in rad.
struct JointCalibration {
  double gain = 1.0;  ///< from kLeastGain to kGreatestGain
  double offset = 0.0;
  /// The least and greatest reported angle in the poses of the calibration, and the RMS error of the fit, in rad.
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
  /// In the order of `hands::kJointNames`. A joint without a value keeps the angle that the device reports.
  std::array<std::optional<JointCalibration>, hands::kJoints> joints{};
  Eigen::Isometry3d X_TH = Eigen::Isometry3d::Identity();  ///< the hand root in the frame of the tracker

  /// Turns reported angles, pose and velocities into those of the hand. Real-time safe.
  void apply(GloveState& state) const noexcept;

  /// Turns limits of the hand's joint angles into limits of the angles that the device reports. Torques stay the same.
  /// Real-time safe.
  JointLimits to_device(const JointLimits& limits) const noexcept;

  /// Turns the descriptor of the bare device into that of the calibrated device.
  DeviceDescriptor calibrated(const DeviceDescriptor& descriptor) const;
};

/// Throws std::invalid_argument if the calibration is for another device or side, or has gains out of range or numbers
/// that are not finite. Also throws if X_TH is not the identity and the device exerts a force or torque on the hand,
/// because such a device must itself report where it exerts them.
GLISSADE_EXPORT void check_calibration(const Calibration& calibration, const DeviceDescriptor& descriptor,
                                       hands::HandSide side);

/// Reads a calibration (YAML, see docs/devices.md). Throws std::invalid_argument, naming file, line and key.
GLISSADE_EXPORT Calibration read_calibration(const std::string& path);
/// Like `read_calibration`, for a text in memory. `source` is the name of the file in messages.
GLISSADE_EXPORT Calibration parse_calibration(const std::string& text, const std::string& source);

/// The text of a calibration file. Reading the text gives the same calibration.
GLISSADE_EXPORT std::string text_of(const Calibration& calibration);

}  // namespace glissade::devices
