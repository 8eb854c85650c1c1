#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/devices/glove_device.h>
#include <glissade/haptics/coupling.h>

#include "loop/lever_limit.h"
#include "loop/loop_settings.h"

namespace glissade::haptics {
namespace {

/// Of springs at the hand, by the damping of the device alone.
contact::CouplingStiffness damping_over_lag(const devices::DeviceDescriptor& device, double lag) noexcept {
  const double own_lag = devices::tool_lag(device, std::chrono::nanoseconds(0), std::chrono::nanoseconds(0));
  return {devices::passive_limit(device.damping, device.max_stiffness, own_lag, lag),
          devices::passive_limit(device.rotational_damping, device.max_rotational_stiffness, own_lag, lag)};
}

contact::CouplingStiffness passive_at(const devices::DeviceDescriptor& device, double lag) noexcept {
  contact::CouplingStiffness limit = damping_over_lag(device, lag);
  if (device.friction > 0.0 && device.resolution > 0.0) {
    limit.translational = std::min(limit.translational, 2.0 * device.friction / device.resolution);
  }
  return limit;
}

}  // namespace

void validate_tick_period(std::chrono::nanoseconds period) {
  if (kShortestTickPeriod <= period && period <= kLongestTickPeriod) return;
  throw std::invalid_argument("the period of the haptic loop must lie between 0.2 and 2 ms, not at " +
                              std::to_string(period.count()) + " ns");
}

contact::CouplingStiffness passive_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                                             std::chrono::nanoseconds delay) noexcept {
  return passive_at(device, devices::tool_lag(device, period, delay));
}

Coupling coupling_for(const devices::DeviceDescriptor& device, const contact::CouplingStiffness& wanted,
                      std::chrono::nanoseconds period, std::chrono::nanoseconds delay) {
  if (!(device.max_stiffness > 0.0 && device.max_rotational_stiffness > 0.0)) {
    throw std::invalid_argument("device '" + device.name +
                                "': it must render some stiffness against translation and rotation");
  }
  return coupling_within_limits(device, wanted, period, delay);
}

Coupling coupling_within_limits(const devices::DeviceDescriptor& device, const contact::CouplingStiffness& wanted,
                                std::chrono::nanoseconds period, std::chrono::nanoseconds delay, double lever,
                                double of_link) noexcept {
  const double lag =
      std::lerp(devices::tool_lag(device, period, delay), devices::lag_of(device, period, delay), of_link);
  // What the device's own damping leaves.
  const auto damping = [lag](double stiffness, double limit) {
    return std::clamp((limit - stiffness) * lag, 0.0, kLoop.damping_time_s * stiffness);
  };
  const contact::CouplingStiffness greatest = damping_over_lag(device, lag);
  const LeverLimit limit{greatest.translational, greatest.rotational, lever};
  const contact::CouplingStiffness passive = passive_at(device, lag);
  Coupling coupling;
  contact::CouplingStiffness& K = coupling.stiffness;
  K.translational = std::min({wanted.translational, device.max_stiffness, passive.translational});
  K.rotational = std::min({wanted.rotational, device.max_rotational_stiffness, passive.rotational});
  const double stiffness_share = limit.share_of(K);
  K = {stiffness_share * K.translational, stiffness_share * K.rotational};

  CouplingDamping& B = coupling.damping;
  B.translational = std::min(damping(K.translational, limit.translational), device.max_damping);
  B.rotational = damping(K.rotational, limit.rotational);
  const double damping_share = limit.share_of_damping(K, {B.translational / lag, B.rotational / lag});
  B = {damping_share * B.translational, damping_share * B.rotational};
  return coupling;
}

contact::Wrench damper_wrench(const CouplingDamping& damping, const contact::Wrench& contacts,
                              const Eigen::Vector3d& v_W, const Eigen::Vector3d& w_W) {
  const auto along = [](const Eigen::Vector3d& push, double coefficient, const Eigen::Vector3d& velocity) {
    const double magnitude = push.norm();
    if (magnitude == 0.0) return Eigen::Vector3d(Eigen::Vector3d::Zero());
    const Eigen::Vector3d direction = push / magnitude;
    return Eigen::Vector3d(std::clamp(-coefficient * velocity.dot(direction), -magnitude, magnitude) * direction);
  };
  return {along(contacts.f, damping.translational, v_W), along(contacts.t, damping.rotational, w_W)};
}

}  // namespace glissade::haptics
