#pragma once

/// A glove with wrong sensors, whose wearer shows the poses of a calibration, on a simulated clock.

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <glissade/bridges/calibration_poses.h>
#include <glissade/devices/calibration.h>
#include <glissade/devices/glove_device.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {

/// What a sensor with this calibration reports: a calibration that is right turns it back.
struct WrongSensors {
  std::array<devices::JointCalibration, hands::kJoints> joints{};

  /// Random gains and offsets, of which a glove of any make is better.
  static WrongSensors random(unsigned seed) {
    WrongSensors sensors;
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> gain(0.5, 2.0);
    std::uniform_real_distribution<double> offset(-0.5, 0.5);
    for (devices::JointCalibration& joint : sensors.joints) {
      joint.gain = gain(generator);
      joint.offset = offset(generator);
    }
    return sensors;
  }

  hands::JointValues reported(const hands::JointValues& angles) const {
    hands::JointValues values{};
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = joints[j].reported(angles[j]);
    return values;
  }
};

/// Measures 100 times a second. The posture at a time is that of `posture`; each reading has white noise of 1 degree.
class PosingGlove final : public devices::GloveDevice {
 public:
  using Posture = std::function<hands::JointValues(double seconds)>;

  PosingGlove(const realtime::SimulatedClock& clock, Posture posture) : clock_(clock), posture_(std::move(posture)) {}

  WrongSensors sensors;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  bool obeys_another = false;

  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  void command(const devices::SafeCommand& /*command*/) noexcept override {}

  bool read(devices::GloveState& newest) noexcept override {
    const double seconds = std::chrono::duration<double>(clock_.now()).count();
    const auto sequence = static_cast<std::int64_t>(100.0 * seconds) + 1;
    if (sequence == newest.sequence) return true;
    newest.sequence = sequence;
    newest.time = clock_.now();
    newest.X_WH = X_WT;
    newest.obeys_another = obeys_another;
    newest.joint_angles = sensors.reported(posture_(seconds));
    std::normal_distribution<double> noise(0.0, 0.0175);
    for (double& angle : newest.joint_angles)
      angle += noise(generator_);
    return true;
  }

 private:
  const realtime::SimulatedClock& clock_;
  Posture posture_;
  devices::DeviceDescriptor descriptor_;
  std::mt19937 generator_{1};
};

}  // namespace glissade::bridges
