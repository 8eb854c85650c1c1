#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/finger_forces.h>

#include "loop/contact_force.h"
#include "loop/loop_settings.h"

namespace glissade::haptics {

namespace {

const FingerHand& checked(const FingerHand& hand) {
  for (std::size_t joint = 0; joint < hand.lower.size(); ++joint) {
    if (hand.lower[joint] <= hand.upper[joint]) continue;
    throw std::invalid_argument("the limits of joint " + std::to_string(joint) + " of a hand are no range");
  }
  return hand;
}

}  // namespace

FingerHand finger_hand(const grasping::HandModel& hand) {
  FingerHand result;
  const std::span<const grasping::FlexValue> values = hand.chain.values();
  for (std::size_t v = 0; v < values.size(); ++v) {
    result.lower[v] = values[v].lower;
    result.upper[v] = values[v].upper;
  }
  for (const std::size_t l : hand.wrist_links) {
    const grasping::ChainLink& link = hand.chain.links()[l];
    result.wrist.push_back({link.terms.front().value, link.X_PJ, link.axis_J});
  }
  return result;
}

double finger_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                        std::chrono::nanoseconds link_delay) noexcept {
  const double wanted = device.max_joint_torque / kLoop.full_torque_rad;
  const bool has_steps = device.joint_friction > 0.0 && device.joint_resolution > 0.0;
  const double without_buzz = has_steps ? 2.0 * device.joint_friction / device.joint_resolution : wanted;
  const double own_lag = devices::lag_of(device, std::chrono::nanoseconds(0), std::chrono::nanoseconds(0));
  const double lag = devices::lag_of(device, period, link_delay);
  return std::min({wanted, without_buzz, devices::joint_torque_rate(device) / kLoop.fastest_finger_rad_per_s,
                   devices::passive_limit(device.joint_damping, wanted, own_lag, lag)});
}

FingerForces::FingerForces(const FingerHand& hand, const devices::DeviceDescriptor& device,
                           std::chrono::nanoseconds period)
    : hand_(checked(hand)),
      device_(device),
      period_(period),
      stiffness_(finger_stiffness(device, period, std::chrono::nanoseconds(0))) {
  devices::validate(device_);
  validate_tick_period(period_);
}

void FingerForces::set_link_delay(std::chrono::nanoseconds delay) noexcept {
  stiffness_ = finger_stiffness(device_, period_, delay);
}

const hands::JointValues& FingerForces::update(const hands::JointValues& angles, const HandAnswer& hand,
                                               std::chrono::nanoseconds age) noexcept {
  torques_.fill(0.0);
  const bool is_finite = std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); });
  if (hand.row_count == 0 || !is_finite) return torques_;
  for (std::size_t j = 0; j < angles.size(); ++j)
    lags_[j] = std::clamp(angles[j], hand_.lower[j], hand_.upper[j]) - hand.visible.angles[j];
  depths_.fill(0.0);
  for (const FingerRow& row : hand.rows())
    deepen(row, lags_, depths_);
  const double share = force_share(age);
  for (std::size_t j = 0; j < angles.size(); ++j) {
    if (depths_[j] == 0.0 || !device_.drives(j)) continue;
    torques_[j] = -std::copysign(share * std::min(stiffness_ * depths_[j], device_.max_joint_torque), lags_[j]);
  }
  return torques_;
}

void deepen(const FingerRow& row, const hands::JointValues& lags, hands::JointValues& depths) noexcept {
  double depth = -row.gap;
  for (std::size_t j = 0; j < lags.size(); ++j)
    depth -= row.rates[j] * lags[j];
  if (depth <= 0.0) return;
  // Of these joints, the lag closes the gap. By the least squares they go back by `multiplier` times their arm, but to
  // the visible hand at most.
  std::array<std::size_t, hands::kJoints> closing{};
  std::size_t count = 0;
  double squares = 0.0;
  const auto arm = [&](std::size_t j) { return lags[j] > 0.0 ? -row.rates[j] : row.rates[j]; };
  for (std::size_t j = 0; j < lags.size(); ++j) {
    if (lags[j] == 0.0 || arm(j) <= 0.0) continue;
    closing[count++] = j;
    squares += arm(j) * arm(j);
  }
  const auto raise = [&](std::size_t j, double back) {
    depths[j] = std::max(depths[j], std::min(1.0, arm(j) / kLoop.short_arm_m) * back);
  };
  while (count > 0) {
    const double multiplier = depth / squares;
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = closing[i];
      if (multiplier * arm(j) < std::abs(lags[j])) {
        closing[left++] = j;
        continue;
      }
      raise(j, std::abs(lags[j]));
      depth -= arm(j) * std::abs(lags[j]);
      squares -= arm(j) * arm(j);
    }
    if (left == count) {
      for (std::size_t i = 0; i < count; ++i)
        raise(closing[i], multiplier * arm(closing[i]));
      return;
    }
    count = left;
  }
}

}  // namespace glissade::haptics
