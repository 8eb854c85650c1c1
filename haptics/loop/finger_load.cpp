#include "loop/finger_load.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glissade/contact/spring.h>
#include <glissade/haptics/finger_forces.h>

#include "loop/loop_settings.h"

namespace glissade::haptics {
namespace {

constexpr int kSweeps = 20;
constexpr double kLeastSquare_m2 = 1e-12;

}  // namespace

FingerLoad::FingerLoad(const devices::DeviceDescriptor& device, std::span<const std::size_t> moves_part,
                       std::chrono::nanoseconds period)
    : max_torque_(device.max_joint_torque),
      stiffness_(finger_stiffness(device, period, std::chrono::nanoseconds(0))),
      period_s_(std::chrono::duration<double>(period).count()),
      given_(kGiven) {
  for (std::size_t j = 0; j < bears_.size(); ++j)
    bears_[j] = device.drives(j);
  for (const std::size_t j : moves_part)
    bears_[j] = false;
}

const hands::JointValues& FingerLoad::update(const HandAnswer& hand, const Load& load,
                                             const hands::JointValues& springs, const hands::JointValues& angles,
                                             double dt) noexcept {
  count_energy(angles, dt);
  forces_.fill(0.0);
  const bool is_loaded =
      has_angles_ && load.part >= 0 && load.radius > 0.0 && !(load.wrench.f.isZero(0.0) && load.wrench.t.isZero(0.0));
  if (is_loaded) share(hand, load);
  follow(hand, angles, dt);
  const double left = std::clamp(energy_ / kLoop.load_fades_J, 0.0, 1.0);
  for (std::size_t j = 0; j < torques_.size(); ++j)
    torques_[j] = std::clamp(left * fading_[j] * borne_[j], -max_torque_ - springs[j], max_torque_ - springs[j]);
  newest_ = (newest_ + 1) % kGiven;
  given_[newest_] = torques_;
  return torques_;
}

/// By projected Gauss–Seidel sweeps from zero.
void FingerLoad::share(const HandAnswer& hand, const Load& load) noexcept {
  const std::span<const FingerRow> rows = hand.rows();
  Vector6 left;
  left << load.wrench.f, load.wrench.t / load.radius;
  for (std::size_t i = 0; i < rows.size(); ++i)
    directions_[i] << rows[i].n_W, (rows[i].p_W - load.p_Wref).cross(rows[i].n_W) / load.radius;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].part != load.part) continue;
      const Vector6& d = directions_[i];
      const double square = d.squaredNorm();
      const double force = std::max(0.0, (d.dot(left) + square * forces_[i]) / (square + kLoop.small_forces));
      left -= (force - forces_[i]) * d;
      forces_[i] = force;
    }
  }
  // Where the load fades it is a spring across the gap, f / 1 mm, which is f r·r / 1 mm against joints with the arms r.
  const auto pressing =
      static_cast<double>(std::count_if(forces_.begin(), forces_.end(), [](double force) { return force > 0.0; }));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (forces_[i] == 0.0) continue;
    double squares = kLeastSquare_m2;
    for (std::size_t j = 0; j < bears_.size(); ++j)
      squares += bears_[j] ? rows[i].rates[j] * rows[i].rates[j] : 0.0;
    forces_[i] = std::min(forces_[i], stiffness_ * (kLoop.load_none_m - kLoop.load_full_m) / (pressing * squares));
  }
}

/// What the forces demand of the joints, within the limits, and which share of it where the glove's segments are.
void FingerLoad::follow(const HandAnswer& hand, const hands::JointValues& angles, double dt) noexcept {
  const std::span<const FingerRow> rows = hand.rows();
  hands::JointValues whole{};
  hands::JointValues present{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (forces_[i] == 0.0) continue;
    double gap = rows[i].gap;
    for (std::size_t j = 0; j < angles.size(); ++j)
      gap += rows[i].rates[j] * (angles[j] - hand.visible.angles[j]);
    const double force =
        forces_[i] * std::clamp((kLoop.load_none_m - gap) / (kLoop.load_none_m - kLoop.load_full_m), 0.0, 1.0);
    for (std::size_t j = 0; j < whole.size(); ++j) {
      whole[j] += forces_[i] * rows[i].rates[j];
      present[j] += force * rows[i].rates[j];
    }
  }
  const double step = max_torque_ * dt / kLoop.load_follows_s;
  for (std::size_t j = 0; j < whole.size(); ++j) {
    double wanted = 0.0;
    if (whole[j] != 0.0 && bears_[j]) {
      wanted = std::clamp(whole[j], -kLoop.load_share * max_torque_, kLoop.load_share * max_torque_);
      const double share = std::clamp(present[j] / whole[j], 0.0, 1.0);
      const double step_of_share = borne_[j] == 0.0 ? 1.0 : dt / kLoop.load_fades_s;
      fading_[j] += std::clamp(share - fading_[j], -step_of_share, step_of_share);
    }
    borne_[j] += std::clamp(wanted - borne_[j], -step, step);
  }
}

/// Of the motion since the last new angles, under the mean of the torques that acted then.
void FingerLoad::count_energy(const hands::JointValues& angles, double dt) noexcept {
  unseen_s_ = std::min(unseen_s_ + dt, kLoop.load_silence_s);
  const bool is_finite = std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); });
  const bool is_new = is_finite && !(has_angles_ && angles == last_angles_);
  if (is_new && has_angles_) {
    const double most = kLoop.load_fastest_rad_per_s * unseen_s_;
    const auto ticks = static_cast<std::size_t>(std::max(1.0, std::round(unseen_s_ / period_s_)));
    const auto late = static_cast<std::size_t>(std::min(std::round(delay_s_ / period_s_), 0.5 * kGiven));
    for (std::size_t j = 0; j < angles.size(); ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < ticks; ++i)
        sum += given_[(newest_ + 2 * kGiven - late - i) % kGiven][j];
      energy_ -= sum / static_cast<double>(ticks) * std::clamp(angles[j] - last_angles_[j], -most, most);
    }
  }
  energy_ = std::clamp(energy_ + kLoop.load_refill_W * dt, 0.0, kLoop.load_most_J);
  has_angles_ = is_finite;
  if (!is_new) return;
  unseen_s_ = 0.0;
  last_angles_ = angles;
}

}  // namespace glissade::haptics
