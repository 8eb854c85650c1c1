#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {
namespace {

/// How far the joint is beyond its range; negative below the lower limit.
double excess_of(const JointLimit& limit, double angle) noexcept {
  return std::max(0.0, angle - limit.upper) + std::min(0.0, angle - limit.lower);
}

}  // namespace

double limit_torque(const JointLimit& limit, double angle, double rate) noexcept {
  const double excess = excess_of(limit, angle);
  const double pushed = limit.stiffness * excess + limit.damping * rate;
  if (excess > 0.0) return -std::clamp(pushed, 0.0, limit.max_torque);
  if (excess < 0.0) return std::clamp(-pushed, 0.0, limit.max_torque);
  return 0.0;
}

double stored_energy(const JointLimit& limit, double angle) noexcept {
  const double excess = std::abs(excess_of(limit, angle));
  const double spring = limit.stiffness * excess;
  if (spring <= limit.max_torque) return 0.5 * spring * excess;
  return limit.max_torque * (excess - 0.5 * limit.max_torque / limit.stiffness);
}

double way_left(std::span<const JointWay> joints, const JointLimits& limits,
                const hands::JointValues& angles) noexcept {
  double shortest = std::numeric_limits<double>::infinity();
  double used_per_way = 0.0;
  for (const JointWay& one : joints) {
    const JointLimit& limit = limits.joints[one.joint];
    const double stop = one.way > 0.0 ? limit.upper : limit.lower;
    if (!(limit.max_torque > 0.0 && std::abs(stop) < kNoLimit_rad)) continue;
    const double left = (stop - angles[one.joint]) / one.way;
    shortest = std::min(shortest, left);
    if (left > 0.0) used_per_way += 1.0 / left;
  }
  return shortest > 0.0 ? 1.0 / used_per_way : shortest;
}

}  // namespace glissade::devices
