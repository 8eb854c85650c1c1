#include <algorithm>

#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/haptic_kernel.h>

#include "loop/contact_force.h"

namespace glissade::haptics {

namespace {
constexpr double kPatiencePeriods = 3.0;
constexpr double kHeadroom = 1.05;  // contacts may demand a little more than the device gives: the envelope tells that
}  // namespace

HapticKernel::HapticKernel(const SlidingPart& part_V, const CouplingStiffness& stiffness,
                           const devices::DeviceDescriptor& device, const Eigen::Isometry3d& X_WV_start,
                           std::chrono::nanoseconds period)
    : p_Vref_(part_V.p_Vref()),
      period_(period),
      coupling_(coupling_for(device, stiffness, period)),
      present_(coupling_),
      envelope_(device, kPatiencePeriods, period),
      X_WV_start_(X_WV_start),
      X_WG_(X_WV_start),
      contacts_(std::make_unique<ContactForce>(part_V.p_Vref(), part_V.radius(), coupling_.stiffness,
                                               kHeadroom * device.max_force, X_WV_start)) {}

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
  const double dt = seconds_since_last_tick(now);
  tick.contacts = scaled(contacts_->update(set, now - set.time, X_WG_, dt), soften(state.link_delay, dt));
  tick.contact_share = contacts_->share();
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
    const Wrench damping = damper_wrench(present_.damping, tick.contacts, ghost);
    const Wrench on_hand = about_point({tick.contacts.f + damping.f, tick.contacts.t + damping.t}, p_Wref, p_WH);
    command.f_H_W = on_hand.f;
    command.t_H_W = on_hand.t;
  }
  tick.command = envelope_.limit(command, state, now);
  return tick;
}

/// Adapts the present coupling to the delay of the link. Returns the share of the coupling's force that is left: force
/// and torque shrink alike, so that the wrench stays a sum of contact normals.
double HapticKernel::soften(std::chrono::nanoseconds link_delay, double dt) noexcept {
  constexpr double kTime_s = 0.1;
  constexpr double kMost_s = 1.0;
  const double delay_s = std::clamp(std::chrono::duration<double>(link_delay).count(), 0.0, kMost_s);
  link_delay_s_ += std::min(1.0, dt / kTime_s) * (delay_s - link_delay_s_);
  const auto delay = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(link_delay_s_));
  present_ = coupling_within_limits(envelope_.descriptor(), coupling_.stiffness, period_, delay);
  return std::min(present_.stiffness.translational / coupling_.stiffness.translational,
                  present_.stiffness.rotational / coupling_.stiffness.rotational);
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
