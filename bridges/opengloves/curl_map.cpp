#include "opengloves/curl_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace glissade::bridges {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// A joint that turns with the curl of its finger.
struct CurlingJoint {
  std::size_t finger;
  std::string_view name;
  double open_deg;
  double closed_deg;
};

constexpr CurlingJoint kCurlingJoints[] = {
    {0, "thumb_mcp", -5, 50}, {0, "thumb_ip", -5, 70},   {0, "thumb_index_abduction", 50, 23},
    {1, "index_mcp", 0, 80},  {1, "index_pip", 0, 100},  {1, "index_dip", 0, 70},
    {2, "middle_mcp", 0, 80}, {2, "middle_pip", 0, 100}, {2, "middle_dip", 0, 70},
    {3, "ring_mcp", 0, 80},   {3, "ring_pip", 0, 100},   {3, "ring_dip", 0, 70},
    {4, "little_mcp", 0, 80}, {4, "little_pip", 0, 100}, {4, "little_dip", 0, 70}};

constexpr double kThumbRoll_deg = 57;  // opposite to the palm

constexpr std::size_t index_of(std::string_view name) {
  return static_cast<std::size_t>(std::find(hands::kJointNames.begin(), hands::kJointNames.end(), name) -
                                  hands::kJointNames.begin());
}

double open_angle(const CurlingJoint& joint) noexcept {
  return joint.open_deg * kRadiansPerDegree;
}

double closed_angle(const CurlingJoint& joint) noexcept {
  return joint.closed_deg * kRadiansPerDegree;
}

}  // namespace

double curl_of(double number, const SensorRange& sensor) noexcept {
  return std::clamp((number - sensor.open) / (sensor.closed - sensor.open), 0.0, 1.0);
}

hands::JointValues lower_angles() noexcept {
  hands::JointValues angles{};
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[index_of(joint.name)] = std::min(open_angle(joint), closed_angle(joint));
  return angles;
}

hands::JointValues upper_angles() noexcept {
  hands::JointValues angles{};
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[index_of(joint.name)] = std::max(open_angle(joint), closed_angle(joint));
  return angles;
}

hands::JointValues angles_of(const FingerValues& curls) noexcept {
  hands::JointValues angles{};
  angles[index_of("thumb_roll")] = kThumbRoll_deg * kRadiansPerDegree;
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[index_of(joint.name)] = std::lerp(open_angle(joint), closed_angle(joint), curls[joint.finger]);
  return angles;
}

FingerValues curl_limits(const devices::JointLimits& limits, double max_torque) noexcept {
  FingerValues least;
  least.fill(1.0);
  for (const CurlingJoint& joint : kCurlingJoints) {
    const devices::JointLimit& limit = limits.joints[index_of(joint.name)];
    const double way = closed_angle(joint) - open_angle(joint);
    const double stop = way > 0.0 ? limit.upper : limit.lower;
    if (!(limit.max_torque > 0.0 && std::abs(stop) < devices::kNoLimit_rad)) continue;
    const double curl = std::clamp((stop - open_angle(joint)) / way, 0.0, 1.0);
    const double share = std::min(1.0, limit.max_torque / max_torque);
    least[joint.finger] = std::min(least[joint.finger], 1.0 - share * (1.0 - curl));
  }
  return least;
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
