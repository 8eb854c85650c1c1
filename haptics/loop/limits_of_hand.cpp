#include "loop/limits_of_hand.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "loop/loop_settings.h"

namespace glissade::haptics {

devices::JointLimits limits_of_hand(const FingerHand& hand, const devices::DeviceDescriptor& device,
                                    const HandAnswer& answer, double share) noexcept {
  devices::JointLimits limits;
  const double max_torque = share * device.max_joint_torque;
  const double stiffness = devices::passive_limit_stiffness(device);
  const double damping = std::min(kLoop.damping_time_s * stiffness, devices::passive_limit_damping(device, stiffness));
  for (const FingerRow& row : answer.rows()) {
    for (std::size_t j = 0; j < hands::kJoints; ++j) {
      const double arm = std::abs(row.rates[j]);
      if (!device.drives(j) || arm < kLoop.short_arm_m) continue;
      devices::JointLimit& limit = limits.joints[j];
      const double visible = answer.visible.angles[j];
      const double free = std::max(0.0, row.gap) / arm;
      // Beyond the joint's own range, nothing is to be limited.
      if (row.rates[j] < 0.0 && visible + free < hand.upper[j]) limit.upper = std::min(limit.upper, visible + free);
      if (row.rates[j] > 0.0 && visible - free > hand.lower[j]) limit.lower = std::max(limit.lower, visible - free);
      const bool is_limited = limit.upper < devices::kNoLimit_rad || limit.lower > -devices::kNoLimit_rad;
      if (!is_limited) continue;
      limit.stiffness = stiffness;
      limit.damping = damping;
      limit.max_torque = max_torque;
    }
  }
  return limits;
}

}  // namespace glissade::haptics
