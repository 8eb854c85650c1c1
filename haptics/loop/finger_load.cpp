#include "loop/finger_load.h"

#include <algorithm>
#include <cmath>

#include <glissade/contact/spring.h>

namespace glissade::haptics {
namespace {

constexpr int kSweeps = 20;
constexpr double kSmallForces = 0.05;  // against forces that cancel each other
constexpr double kFollows_s = 30e-3;
constexpr double kMostEnergy_J = 40e-3;
constexpr double kMostShare = 0.5;  // of the largest torque of a joint
// The glove's segment may be so far off the part: up to kFull_m the load is full, from kNone_m on it is zero. In
// between it acts as a spring, weaker than those of the fingers (kMostShare · max_joint_torque over 1 mm, by the arm).
constexpr double kFull_m = 0.2e-3;
constexpr double kNone_m = 1.2e-3;
constexpr double kRefill_W = 1e-3;

}  // namespace

FingerLoad::FingerLoad(const devices::DeviceDescriptor& device, std::span<const std::size_t> moves_part)
    : max_torque_(device.max_joint_torque) {
  for (std::size_t j = 0; j < bears_.size(); ++j)
    bears_[j] = device.joint_lower[j] != 0.0 || device.joint_upper[j] != 0.0;
  for (const std::size_t j : moves_part)
    bears_[j] = false;
}

const devices::JointValues& FingerLoad::update(const HandAnswer& hand, std::int32_t part, const contact::Wrench& load,
                                               const Eigen::Vector3d& p_Wref, double radius,
                                               const devices::JointValues& angles, double dt) noexcept {
  count_energy(angles, dt);
  wanted_.fill(0.0);
  const bool is_loaded = has_angles_ && part >= 0 && radius > 0.0 && !(load.f.isZero(0.0) && load.t.isZero(0.0));
  if (is_loaded) share(hand, part, load, p_Wref, radius, angles);
  const double left = std::clamp(energy_ / kStart_J, 0.0, 1.0);
  const double step = max_torque_ * dt / kFollows_s;
  for (std::size_t j = 0; j < torques_.size(); ++j) {
    const double most = bears_[j] ? left * kMostShare * max_torque_ : 0.0;
    torques_[j] += std::clamp(std::clamp(wanted_[j], -most, most) - torques_[j], -step, step);
    torques_[j] = std::clamp(torques_[j], -most, most);
  }
  return torques_;
}

/// By projected Gauss–Seidel sweeps from zero.
void FingerLoad::share(const HandAnswer& hand, std::int32_t part, const contact::Wrench& load,
                       const Eigen::Vector3d& p_Wref, double radius, const devices::JointValues& angles) noexcept {
  forces_.fill(0.0);
  const std::span<const FingerRow> rows = hand.rows();
  Vector6 left;
  left << load.f, load.t / radius;
  for (std::size_t i = 0; i < rows.size(); ++i)
    directions_[i] << rows[i].n_W, (rows[i].p_W - p_Wref).cross(rows[i].n_W) / radius;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].part != part) continue;
      const Vector6& d = directions_[i];
      const double square = d.squaredNorm();
      const double force = std::max(0.0, (d.dot(left) + square * forces_[i]) / (square + kSmallForces));
      left -= (force - forces_[i]) * d;
      forces_[i] = force;
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (forces_[i] == 0.0) continue;
    double gap = rows[i].gap;
    for (std::size_t j = 0; j < angles.size(); ++j)
      gap += rows[i].rates[j] * (angles[j] - hand.visible.angles[j]);
    const double force = forces_[i] * std::clamp((kNone_m - gap) / (kNone_m - kFull_m), 0.0, 1.0);
    for (std::size_t j = 0; j < wanted_.size(); ++j)
      wanted_[j] += force * rows[i].rates[j];
  }
}

/// Of the torques since the last call.
void FingerLoad::count_energy(const devices::JointValues& angles, double dt) noexcept {
  const bool is_finite = std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); });
  if (has_angles_ && is_finite) {
    for (std::size_t j = 0; j < angles.size(); ++j)
      energy_ -= torques_[j] * (angles[j] - last_angles_[j]);
  }
  energy_ = std::min(energy_ + kRefill_W * dt, kMostEnergy_J);
  has_angles_ = is_finite;
  if (is_finite) last_angles_ = angles;
}

}  // namespace glissade::haptics
