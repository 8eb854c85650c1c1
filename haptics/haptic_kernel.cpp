#include <algorithm>

#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

Coupling coupling_for(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted) {
  constexpr double kDampingTime_s = 5e-3;
  Coupling coupling;
  coupling.stiffness.translational = std::min(wanted.translational, device.max_stiffness);
  coupling.stiffness.rotational = std::min(wanted.rotational, device.max_rotational_stiffness);
  coupling.damping.translational = std::min(kDampingTime_s * coupling.stiffness.translational, device.max_damping);
  coupling.damping.rotational = kDampingTime_s * coupling.stiffness.rotational;
  return coupling;
}

HapticKernel::HapticKernel(const SlidingPart& part_V, const Coupling& coupling, const devices::DeviceDescriptor& device,
                           const Eigen::Isometry3d& X_WV_start)
    : p_Vref_(part_V.p_Vref()),
      coupling_(coupling),
      device_(device),
      X_WV_start_(X_WV_start),
      proxy_(part_V.p_Vref(), part_V.radius(), coupling.stiffness, X_WV_start) {}

HapticTick HapticKernel::tick(const devices::GloveState& state, const ContactSet& set,
                              std::chrono::nanoseconds dt) noexcept {
  if (!grasped_) {
    X_HG_ = state.X_WH.inverse() * X_WV_start_;
    grasped_ = true;
  }
  HapticTick tick;
  tick.X_WG = state.X_WH * X_HG_;
  const Eigen::Isometry3d X_WP_before = proxy_.pose();
  tick.X_WP = proxy_.update(set, tick.X_WG);

  Wrench wrench;
  const Eigen::Vector3d p_Wref = tick.X_WG * p_Vref_;
  if (tick.X_WP.matrix() != tick.X_WG.matrix()) {  // in free space nothing is felt, not even damping
    tick.spring = spring_wrench(coupling_.stiffness, displacement_between(tick.X_WP, tick.X_WG, p_Vref_));
    const Wrench damping = damper(state, p_Wref, displacement_between(X_WP_before, tick.X_WP, p_Vref_), dt);
    wrench = {tick.spring.f + damping.f, tick.spring.t + damping.t};
  }
  const Wrench on_hand = about_point(wrench, p_Wref, state.X_WH.translation());

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

Wrench HapticKernel::damper(const devices::GloveState& state, const Eigen::Vector3d& p_Wref,
                            const Displacement& proxy_motion, std::chrono::nanoseconds dt) const noexcept {
  const double seconds = std::chrono::duration<double>(dt).count();
  if (!(seconds > 0.0)) return {};
  const Velocity ghost{state.v_WH + state.w_WH.cross(p_Wref - state.X_WH.translation()), state.w_WH};
  const Velocity proxy{proxy_motion.v / seconds, proxy_motion.w / seconds};
  return damper_wrench(coupling_.damping, proxy, ghost);
}

}  // namespace glissade::haptics
