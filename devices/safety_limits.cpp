#include <algorithm>
#include <cmath>

#include <glissade/devices/safety_limits.h>

namespace glissade::devices {
namespace {

double usable(double limit) noexcept {
  return limit > 0.0 ? limit : 0.0;
}

/// Scales `vector` down to the norm `limit` if it exceeds it; returns whether it did.
bool limit_norm(Eigen::Vector3d& vector, double limit) noexcept {
  // Division by the largest component comes first: the squares of huge components would overflow, and so might their
  // sum.
  const double largest = vector.lpNorm<Eigen::Infinity>();
  if (largest <= limit && vector.norm() <= limit) return false;
  vector /= largest;
  vector *= limit / vector.norm();
  // Rounding may have left the norm a few units in the last place too large.
  constexpr double kJustBelowOne = 1.0 - 1e-15;
  if (vector.norm() > limit) vector *= kJustBelowOne;
  return true;
}

bool is_finite(const GloveCommand& command) noexcept {
  return command.f_H_W.allFinite() && command.t_H_W.allFinite() &&
         std::all_of(command.joint_torques.begin(), command.joint_torques.end(),
                     [](double t) { return std::isfinite(t); });
}

}  // namespace

LimitedCommand limit_command(const GloveCommand& command, const DeviceDescriptor& descriptor) noexcept {
  LimitedCommand limited{command, {}};
  GloveCommand& safe = limited.command;
  if (!is_finite(command)) {
    safe.f_H_W.setZero();
    safe.t_H_W.setZero();
    safe.joint_torques.fill(0.0);
    limited.reasons.not_finite = true;
    return limited;
  }
  limited.reasons.force_limited = limit_norm(safe.f_H_W, usable(descriptor.max_force));
  limited.reasons.torque_limited = limit_norm(safe.t_H_W, usable(descriptor.max_torque));
  const double joint_limit = usable(descriptor.max_joint_torque);
  for (double& torque : safe.joint_torques) {
    if (std::abs(torque) <= joint_limit) continue;
    torque = std::copysign(joint_limit, torque);
    limited.reasons.joints_limited = true;
  }
  return limited;
}

}  // namespace glissade::devices
