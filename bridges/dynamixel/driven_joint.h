#pragma once

/// A joint and its servo, as the wire knows them.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glissade/bridges/dynamixel_hand.h>

#include "dynamixel/joint_scale.h"
#include "dynamixel/limit_holder.h"
#include "dynamixel/servo_bus.h"

namespace glissade::bridges::dynamixel {

/// What is known of one servo and wanted from it.
struct DrivenJoint {
  DrivenJoint(const DynamixelHand& hand, const DynamixelServo& servo, const ServoModel& model);

  /// Takes the registers Present Current to Present Position.
  void take_measurement(const std::string& registers);
  /// The goal for the newest angle.
  void set_limit(const devices::JointLimit& limit) noexcept { goal = holder.update(limit, angle); }
  /// The torque is off, and nothing is known of the goals in the servo.
  void forget() noexcept;

  std::uint8_t id;
  std::size_t joint;
  JointScale scale;
  LimitHolder holder;
  double angle = std::numeric_limits<double>::quiet_NaN();  // rad; not measured yet
  double rate = 0.0;                                        // rad/s
  HoldGoal goal;
  bool has_torque = false;           // what was sent
  std::optional<std::int64_t> gain;  // what was sent
};

/// Sends the goals of all joints. Servos without torque are told so in each period, because these instructions have no
/// answer. A servo whose torque turns on gets its goals before, and again afterwards: it may start at a goal of its
/// own, the present position. Throws WireError.
void send_goals(ServoBus& bus, std::vector<DrivenJoint>& joints);

/// The bytes that turn the torque of these servos off.
std::string torque_off(std::span<const std::uint8_t> ids);

/// The registers that are read in each period.
inline constexpr const Register& kFirstMeasured = kPresentCurrent;
inline constexpr std::uint16_t kMeasuredSize =
    kPresentPosition.address + kPresentPosition.size - kPresentCurrent.address;

}  // namespace glissade::bridges::dynamixel
