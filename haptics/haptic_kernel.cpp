#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/haptic_kernel.h>

#include "loop/proxy.h"

namespace glissade::haptics {

HapticKernel::HapticKernel(const SlidingPart& part_V, const CouplingStiffness& stiffness,
                           const devices::DeviceDescriptor& device, const Eigen::Isometry3d& X_WV_start)
    : p_Vref_(part_V.p_Vref()),
      coupling_(coupling_for(device, stiffness)),
      device_(device),
      X_WV_start_(X_WV_start),
      X_WG_(X_WV_start),
      proxy_(std::make_unique<Proxy>(part_V.p_Vref(), part_V.radius(), coupling_.stiffness, X_WV_start)) {}

HapticKernel::~HapticKernel() = default;

HapticTick HapticKernel::tick(const devices::GloveState& state, const ContactSet& set) noexcept {
  if (!state.X_WH.matrix().allFinite()) return no_force(state);
  if (!grasped_) {
    X_HG_ = state.X_WH.inverse() * X_WV_start_;
    grasped_ = true;
  }
  HapticTick tick;
  tick.X_WG = state.X_WH * X_HG_;
  X_WG_ = tick.X_WG;
  tick.X_WP = proxy_->update(set, tick.X_WG);

  const Eigen::Vector3d& p_WH = state.X_WH.translation();
  const Eigen::Vector3d p_Wref = tick.X_WG * p_Vref_;
  Wrench wrench;
  if (tick.X_WP.matrix() != tick.X_WG.matrix()) {
    tick.spring = spring_wrench(coupling_.stiffness, geometry::displacement_between(tick.X_WP, tick.X_WG, p_Vref_));
    const Velocity ghost{state.v_WH + state.w_WH.cross(p_Wref - p_WH), state.w_WH};
    const Wrench damping = damper_wrench(coupling_.damping, tick.spring, ghost);
    wrench = {tick.spring.f + damping.f, tick.spring.t + damping.t};
  }
  const Wrench on_hand = about_point(wrench, p_Wref, p_WH);

  devices::GloveCommand command;
  command.sequence = ++sequence_;
  command.state_sequence = state.sequence;
  command.time = state.time;
  command.f_H_W = on_hand.f;
  command.t_H_W = on_hand.t;
  const devices::LimitedCommand limited = devices::limit_command(command, device_);
  tick.command = limited.command;
  tick.limited = limited.reasons;
  return tick;
}

HapticTick HapticKernel::no_force(const devices::GloveState& state) noexcept {
  HapticTick tick;
  tick.X_WG = X_WG_;
  tick.X_WP = X_WG_;
  tick.command.sequence = ++sequence_;
  tick.command.state_sequence = state.sequence;
  tick.command.time = state.time;
  tick.limited.not_finite = true;
  return tick;
}

}  // namespace glissade::haptics
