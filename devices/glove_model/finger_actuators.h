#pragma once

/// What the actuators of a device do with a command: the device's own loop, its delay, and the lag of its torque.

#include <array>
#include <chrono>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/glove_model.h>
#include <glissade/hands/hand.h>

#include "glove_model/delay_line.h"

namespace glissade::devices {

/// The command as the device has it.
struct FingerOrder {
  hands::JointValues torques{};         ///< Nm, for motors that exert torques
  const JointLimits* limits = nullptr;  ///< not null, for all other devices
  std::chrono::nanoseconds age{0};      ///< since the device has heard the command
  /// Not null if the firmware knows at which sums of angles (rad) the strings are to be taut. They replace `limits`.
  const std::array<double, 5>* taut_sums = nullptr;
};

/// `angle` (rad) in steps of `resolution`; the same angle if `resolution` is 0.
double quantised(double angle, double resolution) noexcept;

/// The motors and brakes of a device. Torques are those at the joints. Beyond what a motor can exert, a torque is left
/// to the brake, which only resists.
class FingerActuators {
 public:
  FingerActuators(const GloveModel& model, const hands::JointValues& angles);

  /// Advances by `h` seconds to the time `now`. `angles` are those of the actuators, rad. Cost O(joints).
  void advance(std::chrono::nanoseconds now, double h, const FingerOrder& order,
               const hands::JointValues& angles) noexcept;

  double motor_torque(std::size_t joint) const noexcept;  ///< Nm
  /// Resistance of the brake against rising and falling angles, Nm.
  double brake_rising(std::size_t joint) const noexcept;
  double brake_falling(std::size_t joint) const noexcept;

 private:
  void measure(std::chrono::nanoseconds now, const FingerOrder& order, const hands::JointValues& angles) noexcept;

  FingerKind kind_;
  ActuatorModel actuator_;
  ServoModel servo_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds delay_;
  std::chrono::nanoseconds next_{0};
  hands::JointValues measured_;
  DelayLine<hands::JointValues> on_the_way_;
  hands::JointValues wanted_{};   ///< torques, Nm
  hands::JointValues exerted_{};  ///< the same after the lag
};

/// Strings that stop the flexion of each finger, each held by a servo.
class FingerStrings {
 public:
  explicit FingerStrings(const GloveModel& model);

  /// Advances by `h` seconds to the time `now`. `angles` and `rates` are those of the joints, rad and rad/s.
  void advance(std::chrono::nanoseconds now, double h, const FingerOrder& order, const hands::JointValues& angles,
               const hands::JointValues& rates) noexcept;

  double torque(std::size_t joint) const noexcept { return torques_[joint]; }  ///< on the finger, Nm

 private:
  static constexpr std::size_t kFingers = 5;
  using CurlValues = std::array<double, kFingers>;

  CurlValues limits_of(const FingerOrder& order, const hands::JointValues& angles) const noexcept;

  StringModel string_;
  ServoModel servo_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds delay_;
  std::chrono::nanoseconds next_{0};
  CurlValues open_{};  ///< the sum of angles of each closed finger, rad
  DelayLine<CurlValues> on_the_way_;
  CurlValues wanted_;
  CurlValues held_;  ///< the sum of angles at which the string is taut, rad
  hands::JointValues torques_{};
};

}  // namespace glissade::devices
