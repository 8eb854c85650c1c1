#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/devices/glove_device.h>
#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

void validate_tick_period(std::chrono::nanoseconds period) {
  if (kShortestTickPeriod <= period && period <= kLongestTickPeriod) return;
  throw std::invalid_argument("the period of the haptic loop must lie between 0.2 and 2 ms, not at " +
                              std::to_string(period.count()) + " ns");
}

CouplingStiffness default_stiffness(double radius) {
  constexpr double kTranslational_N_per_m = 1000.0;
  return {kTranslational_N_per_m, kTranslational_N_per_m * radius * radius};
}

void validate(const CouplingStiffness& stiffness, const std::string& part_name) {
  const auto is_stiffness = [](double k) { return k > 0.0 && std::isfinite(k); };
  if (is_stiffness(stiffness.translational) && is_stiffness(stiffness.rotational)) return;
  throw std::invalid_argument("the stiffness with which " + part_name + " is held is not a positive number");
}

Coupling coupling_for(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted) {
  constexpr double kDampingTime_s = 5e-3;
  if (!(device.max_stiffness > 0.0 && device.max_rotational_stiffness > 0.0)) {
    throw std::invalid_argument("device '" + device.name +
                                "': it must render some stiffness against translation and rotation");
  }
  Coupling coupling;
  coupling.stiffness.translational = std::min(wanted.translational, device.max_stiffness);
  coupling.stiffness.rotational = std::min(wanted.rotational, device.max_rotational_stiffness);
  coupling.damping.translational = std::min(kDampingTime_s * coupling.stiffness.translational, device.max_damping);
  coupling.damping.rotational = kDampingTime_s * coupling.stiffness.rotational;
  return coupling;
}

Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {wrench.f, wrench.t + (from - to).cross(wrench.f)};
}

Wrench spring_wrench(const CouplingStiffness& stiffness, const geometry::Displacement& error) {
  return {-stiffness.translational * error.v, -stiffness.rotational * error.w};
}

Wrench damper_wrench(const CouplingDamping& damping, const Wrench& contacts, const Velocity& ghost) {
  const auto along = [](const Eigen::Vector3d& push, double coefficient, const Eigen::Vector3d& velocity) {
    const double magnitude = push.norm();
    if (magnitude == 0.0) return Eigen::Vector3d(Eigen::Vector3d::Zero());
    const Eigen::Vector3d direction = push / magnitude;
    return Eigen::Vector3d(std::clamp(-coefficient * velocity.dot(direction), -magnitude, magnitude) * direction);
  };
  return {along(contacts.f, damping.translational, ghost.v), along(contacts.t, damping.rotational, ghost.w)};
}

}  // namespace glissade::haptics
