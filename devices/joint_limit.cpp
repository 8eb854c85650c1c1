#include <algorithm>
#include <cmath>

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

}  // namespace glissade::devices
