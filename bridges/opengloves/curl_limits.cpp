#include "opengloves/curl_limits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hand/finger_curls.h"

namespace glissade::bridges {

double curl_of(double number, const SensorRange& sensor) noexcept {
  return std::clamp((number - sensor.open) / (sensor.closed - sensor.open), 0.0, 1.0);
}

FingerValues curl_limits(const devices::JointLimits& limits, const FingerValues& curls, double max_torque) noexcept {
  const hands::JointValues angles = angles_of(curls);
  devices::JointLimits faded = limits;
  std::array<std::array<devices::JointWay, kJointsOfFinger>, kFingers> ways{};
  std::array<std::size_t, kFingers> count{};
  for (const CurlingJoint& joint : curling_joints()) {
    devices::JointLimit& limit = faded.joints[joint.joint];
    double& stop = joint.closed > joint.open ? limit.upper : limit.lower;
    const double share = std::min(1.0, limit.max_torque / max_torque);
    if (std::abs(stop) < devices::kNoLimit_rad) stop = joint.closed - share * (joint.closed - stop);
    ways[joint.finger][count[joint.finger]++] = {joint.joint, joint.closed - joint.open};
  }
  FingerValues most{};
  for (std::size_t f = 0; f < kFingers; ++f)
    most[f] = std::clamp(curls[f] + devices::way_left(ways[f], faded, angles), 0.0, 1.0);
  return most;
}

FingerNumbers limit_numbers(const FingerValues& curl_limits, const FingerValues& curls) noexcept {
  FingerNumbers numbers{};
  for (std::size_t f = 0; f < kFingers; ++f) {
    const double curl = std::clamp(std::max(curl_limits[f], curls[f]), 0.0, 1.0);
    numbers[f] = static_cast<int>(std::floor(kLargestLimit * (1.0 - curl)));
  }
  return numbers;
}

}  // namespace glissade::bridges
