#include "loop/fingers_of_hand.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glissade/contact/spring.h>

#include "loop/contact_force.h"
#include "loop/loop_settings.h"

namespace glissade::haptics {
namespace {

const FingerHand& checked_wrist(const FingerHand& hand) {
  for (const WristJoint& joint : hand.wrist) {
    const bool is_axis = std::abs(joint.axis_J.norm() - 1.0) < 1e-6;  // false for NaN
    if (joint.angle < hands::kJoints && is_axis && joint.X_PJ.matrix().allFinite()) continue;
    throw std::invalid_argument("a joint of the wrist needs a joint of the glove, a pose, and an axis of unit length");
  }
  return hand;
}

std::vector<std::size_t> joints_of_wrist(const FingerHand& hand) {
  std::vector<std::size_t> joints;
  for (const WristJoint& joint : hand.wrist)
    joints.push_back(joint.angle);
  return joints;
}

}  // namespace

FingersOfHand::FingersOfHand(const FingerHand& hand, const devices::DeviceDescriptor& device,
                             std::chrono::nanoseconds period)
    : hand_(checked_wrist(hand)),
      forces_(hand, device, period),
      load_(device, joints_of_wrist(hand), period),
      device_(device) {
  set_link_delay(std::chrono::nanoseconds(0));
}

bool FingersOfHand::have_angles(const devices::GloveState& state) noexcept {
  return std::all_of(state.joint_angles.begin(), state.joint_angles.end(),
                     [](double angle) { return std::isfinite(angle); });
}

void FingersOfHand::move_palm(const devices::GloveState& state, double dt) noexcept {
  X_WP_ = state.X_WH;
  for (const WristJoint& joint : hand_.wrist) {
    const std::size_t j = joint.angle;
    const double wanted = std::clamp(state.joint_angles[j], hand_.lower[j], hand_.upper[j]);
    const double step = is_found_
                            ? std::clamp(wanted - angles_[j], -kLoop.palm_rad_per_s * dt, kLoop.palm_rad_per_s * dt)
                            : wanted - angles_[j];
    angles_[j] += step;
    X_WP_ = X_WP_ * joint.X_PJ * Eigen::AngleAxisd(angles_[j], joint.axis_J);
  }
  is_found_ = true;
}

bool FingersOfHand::is_new(std::int64_t decision) noexcept {
  return std::exchange(decision_, decision) != decision;
}

void FingersOfHand::set_link_delay(std::chrono::nanoseconds delay) noexcept {
  forces_.set_link_delay(delay);
  load_.set_link(std::chrono::duration<double>(device_.delay + delay).count(), forces_.stiffness());
}

devices::JointLimits FingersOfHand::limits(const HandAnswer& answer, std::chrono::nanoseconds age, double dt) noexcept {
  limits_share_ = std::min(force_share(age), limits_share_ + dt / kLoop.return_s);
  return limits_of_hand(hand_, device_, answer, limits_share_);
}

hands::JointValues FingersOfHand::torques(const devices::GloveState& state, const HandAnswer& answer,
                                          std::chrono::nanoseconds age, const FingerLoad::Load& load,
                                          double dt) noexcept {
  hands::JointValues sum = forces_.update(state.joint_angles, answer, age);
  const hands::JointValues& of_load = load_.update(answer, load, sum, state.joint_angles, dt);
  for (std::size_t j = 0; j < sum.size(); ++j)
    sum[j] += of_load[j];
  return sum;
}

void FingersOfHand::note(const devices::GloveState* seen, std::optional<std::size_t> part, double dt) noexcept {
  // One that comes late may be too old for a force, but tells all the same where the hand is.
  const bool has_come = seen != nullptr && std::exchange(time_seen_, seen->time) != seen->time;
  unseen_s_ = has_come ? 0.0 : unseen_s_ + dt;
  ghost_.part = part ? static_cast<std::int32_t>(*part) : -1;
  ghost_.is_tracked = is_found_ && unseen_s_ < kLoop.lost_after_s;
  if (seen == nullptr) return;
  ghost_.X_WH = seen->X_WH;
  ghost_.angles = seen->joint_angles;
}

}  // namespace glissade::haptics
