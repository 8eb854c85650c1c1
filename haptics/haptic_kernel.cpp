#include <algorithm>

#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/haptic_kernel.h>

#include "loop/contact_force.h"

namespace glissade::haptics {

HapticKernel::HapticKernel(const SlidingPart& part_V, const CouplingStiffness& stiffness,
                           const devices::DeviceDescriptor& device, const Eigen::Isometry3d& X_WV_start)
    : p_Vref_(part_V.p_Vref()),
      coupling_(coupling_for(device, stiffness)),
      envelope_(device),
      X_WV_start_(X_WV_start),
      X_WG_(X_WV_start),
      contacts_(std::make_unique<ContactForce>(part_V.p_Vref(), part_V.radius(), coupling_.stiffness, X_WV_start)) {}

HapticKernel::~HapticKernel() = default;

HapticTick HapticKernel::tick(const devices::GloveState& state, const ContactSet& set,
                              std::chrono::nanoseconds now) noexcept {
  const bool has_pose = state.X_WH.matrix().allFinite() && state.v_WH.allFinite() && state.w_WH.allFinite();
  if (has_pose && !grasped_) {
    X_HG_ = state.X_WH.inverse() * X_WV_start_;
    grasped_ = true;
  }
  if (has_pose) X_WG_ = state.X_WH * X_HG_;

  HapticTick tick;
  tick.X_WG = X_WG_;
  tick.contacts = contacts_->update(set, now - set.time, X_WG_, seconds_since_last_tick(now));
  tick.is_unsolved = contacts_->is_unsolved();

  devices::GloveCommand command;
  command.sequence = ++sequence_;
  command.state_sequence = state.sequence;
  command.state_time = state.time;
  command.time = now;
  if (has_pose) {
    const Eigen::Vector3d& p_WH = state.X_WH.translation();
    const Eigen::Vector3d p_Wref = X_WG_ * p_Vref_;
    const Velocity ghost{state.v_WH + state.w_WH.cross(p_Wref - p_WH), state.w_WH};
    const Wrench damping = damper_wrench(coupling_.damping, tick.contacts, ghost);
    const Wrench on_hand = about_point({tick.contacts.f + damping.f, tick.contacts.t + damping.t}, p_Wref, p_WH);
    command.f_H_W = on_hand.f;
    command.t_H_W = on_hand.t;
  }
  tick.command = envelope_.limit(command, state, now);
  return tick;
}

double HapticKernel::seconds_since_last_tick(std::chrono::nanoseconds now) noexcept {
  // A pause is no reason for a jump.
  const std::chrono::nanoseconds passed = last_tick_ ? now - *last_tick_ : kTickPeriod;
  last_tick_ = now;
  return std::chrono::duration<double>(
             std::clamp<std::chrono::nanoseconds>(passed, std::chrono::nanoseconds(0), kLongestTickPeriod))
      .count();
}

}  // namespace glissade::haptics
