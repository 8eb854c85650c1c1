#pragma once

/// Guides a wearer through the poses of a calibration.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/bridges/calibration_fit.h>
#include <glissade/devices/calibration.h>
#include <glissade/devices/glove_device.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {

struct GuidedCalibrationOptions {
  std::chrono::duration<double> pause{5.0};  ///< time before each pose, in which the wearer takes it
  std::chrono::duration<double> hold{2.0};   ///< time for which a pose is held still
  int tries = 3;                             ///< for each pose
  std::vector<std::string> without{};        ///< joints that stay as the device reports them
  /// The hand root in the pose "flat", in the world, to find where a tracker is worn; no value: `X_TH` is not fitted.
  std::optional<Eigen::Isometry3d> X_WH_flat{};
};

/// Output for people. `say` receives a sentence, and `show` a line that replaces the last one, such as a countdown.
struct CalibrationVoice {
  std::function<void(const std::string&)> say;
  std::function<void(const std::string&)> show;
};

struct GuidedCalibration {
  devices::Calibration calibration;  ///< without a user
  std::vector<std::string> remarks;  ///< `JointFits::remarks`
};

/// Asks for each pose, waits, measures the pose, and asks again if the hand moved. Reads the states of `glove` on
/// `clock`. Returns no value if `goes_on`, which is called in each period, returns false. Throws CalibrationError if a
/// pose fails `tries` times, for bad data, and if a server commands the glove: its limits stop fingers.
std::optional<GuidedCalibration> guide_calibration(devices::GloveDevice& glove, const devices::GloveInfo& info,
                                                   const GuidedCalibrationOptions& options, realtime::Clock& clock,
                                                   const std::function<bool()>& goes_on, const CalibrationVoice& voice);

}  // namespace glissade::bridges
