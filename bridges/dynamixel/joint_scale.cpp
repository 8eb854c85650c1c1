#include "dynamixel/joint_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::bridges::dynamixel {
namespace {

constexpr std::int64_t kLargestGain = 16383;
constexpr std::int64_t kLargestPosition = 1048575;  // 256 turns either way

}  // namespace

JointScale::JointScale(const DynamixelHand& hand, const DynamixelServo& servo, const ServoModel& model) noexcept
    : ratio_(servo.ratio), absolute_ratio_(std::abs(servo.ratio)), zero_(servo.zero) {
  const double at_horn = servo.torque_per_current > 0.0 ? servo.torque_per_current : torque_per_current(model);
  torque_per_current_ = at_horn / absolute_ratio_;
  stiffness_per_gain_ = hand.current_per_gain * at_horn / kPositionUnit_rad / (servo.ratio * servo.ratio);
  max_current_ = to_counts(kCurrentLimit, std::min(servo.max_current, model.max_current_A));
  play_ = model.backlash_rad * absolute_ratio_;
}

void JointScale::choose_turn(std::int64_t position, double lower, double upper) noexcept {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double middle_at_horn = zero_ + 0.5 * (lower + upper) / ratio_;
  const double horn = static_cast<double>(position) * kPositionUnit_rad;
  zero_ += kTurn_rad * std::round((horn - middle_at_horn) / kTurn_rad);
}

double JointScale::angle(std::int64_t position) const noexcept {
  return ratio_ * (static_cast<double>(position) * kPositionUnit_rad - zero_);
}

double JointScale::rate(std::int64_t velocity) const noexcept {
  return ratio_ * static_cast<double>(velocity) * kVelocityUnit_rad_per_s;
}

std::int64_t JointScale::position(double angle) const noexcept {
  return std::clamp(to_counts(kGoalPosition, zero_ + angle / ratio_), -kLargestPosition, kLargestPosition);
}

std::int64_t JointScale::current(double torque) const noexcept {
  // Rounded down: never more than the limit.
  const double counts = std::floor(std::max(0.0, torque) / torque_per_current_ / kCurrentUnit_A + 1e-9);
  return counts < static_cast<double>(max_current_) ? static_cast<std::int64_t>(counts) : max_current_;
}

std::int64_t JointScale::p_gain(double stiffness) const noexcept {
  const double gain = std::round(std::max(0.0, stiffness) / stiffness_per_gain_);
  return gain < static_cast<double>(kLargestGain) ? static_cast<std::int64_t>(gain) : kLargestGain;
}

double JointScale::max_torque() const noexcept {
  return static_cast<double>(max_current_) * kCurrentUnit_A * torque_per_current_;
}

double JointScale::max_stiffness() const noexcept {
  return static_cast<double>(kLargestGain) * stiffness_per_gain_;
}

}  // namespace glissade::bridges::dynamixel
