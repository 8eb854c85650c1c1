#include "envelope/half_space_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "envelope/envelope_numbers.h"
#include "envelope/envelope_settings.h"
#include "half_spaces/held_spring.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;

/// The shares of a vector, 0 to 1, that differ from `last` by at most `step`. `most` bounds the norm of a share.
struct Shares {
  double least = 0.0;
  double most = 1.0;
};

Shares shares_near(const Vector3d& whole, double most, const Vector3d& last, double step) noexcept {
  constexpr Shares kNone{1.0, 0.0};
  const double norm = whole.norm();
  if (norm == 0.0) return last.norm() <= step ? Shares{} : kNone;
  const double along = whole.dot(last) / norm;
  const double square = step * step - (last.squaredNorm() - along * along);
  if (square < 0.0) return kNone;
  const double way = std::sqrt(square);
  return {(along - way) / norm, along + way >= std::min(norm, most) ? 1.0 : (along + way) / norm};
}

}  // namespace

HalfSpaceLimits::HalfSpaceLimits(const DeviceDescriptor& descriptor, const RateLimit& rates, double period_s)
    : descriptor_(descriptor),
      rates_(rates),
      lag_s_(tool_lag(descriptor, std::chrono::nanoseconds(0), std::chrono::nanoseconds(0))),
      translational_(passive_limit(descriptor.damping, descriptor.max_stiffness, lag_s_, lag_s_)),
      rotational_(passive_limit(descriptor.rotational_damping, descriptor.max_rotational_stiffness, lag_s_, lag_s_)),
      fade_s_(kEnvelope.fade_periods * period_s),
      expiry_(expiry_of_limits(period_s)),
      pose_(descriptor.resolution, descriptor.max_force) {}

HeldEnergy HalfSpaceLimits::want(const HalfSpaces& wanted, const GloveState& state, bool is_fading, const Fade& fade,
                                 double most_N, double dt, LimitReasons& reasons) noexcept {
  if (!are_taken()) return {};
  if (is_fading) begin_fade();
  X_WH_ = state.X_WH;
  observe_rest(X_WH_, dt);
  if (before_fade_) left_J_ = std::min(left_J_, stored_energy(*before_fade_, X_WH_));
  if (is_fading) {
    next_ = last_;
    next_.max_force = std::max(0.0, last_.max_force - dt / fade_s_ * descriptor_.max_force);
    change_softly(dt);  // a device may be too slow for this, or the torque too great
    return {};
  }
  const double returned = take_back();
  next_ = within_device(wanted, most_N, reasons);
  next_.expiry = expiry_;
  const HeldSpring whole(next_, X_WH_);
  wanted_wrench_ = whole.wrench(whole.size());
  next_.max_force *= fade.gain();
  if (change_softly(dt)) reasons.rate_limited = true;
  const double gain = stored_energy(next_, X_WH_) - stored_energy(last_, X_WH_);
  return {.presses = whole.depth() > 0.0 || stored_energy(last_, X_WH_) > 0.0,
          .rests = resting_for_s_ > kEnvelope.rested_s,
          .gain = gain,
          .returned = returned};
}

bool HalfSpaceLimits::drop() noexcept {
  if (!last_.any()) return false;
  begin_fade();
  last_ = {.expiry = expiry_};
  return true;
}

double HalfSpaceLimits::give(double available_J, double dt, LimitReasons& reasons) noexcept {
  if (!are_taken()) return 0.0;
  const HeldSpring spring(next_, X_WH_);
  const double before_J = stored_energy(last_, X_WH_);
  if (spring.energy() > before_J + available_J) {
    // Far behind half-spaces, a small force has much energy.
    next_.max_force = std::min(next_.max_force, spring.force_for(before_J + available_J));
    change_softly(dt);
    reasons.energy_limited = true;
  }
  if (!next_.any()) next_ = {.expiry = expiry_};
  last_ = next_;
  const HeldSpring given(last_, X_WH_);
  given_wrench_ = given.wrench(given.size());
  return given.energy() - before_J;
}

HalfSpaces HalfSpaceLimits::within_device(const HalfSpaces& wanted, double most_N,
                                          LimitReasons& reasons) const noexcept {
  if (!wanted.any()) return {};
  HalfSpaces limited = wanted;
  limited.count = std::min(limited.count, kMaxHalfSpaces);
  double& K = limited.stiffness;
  double& K_r = limited.rotational_stiffness;
  K = std::min({K, translational_, descriptor_.max_stiffness});
  K_r = std::min({K_r, rotational_, descriptor_.max_rotational_stiffness});
  // A spring beside the hand root also turns the hand (haptics/loop/lever_limit.h).
  const double of_lever = K * translational_ * wanted.p_HR.squaredNorm();
  const auto is_passive = [&](double share) {
    return (translational_ - share * K) * (rotational_ - share * K_r) >= share * of_lever;
  };
  double share = is_passive(1.0) ? 1.0 : 0.0;
  for (double step = 0.5; share < 1.0 && step > 1e-6; step *= 0.5) {
    if (is_passive(share + step)) share += step;
  }
  K *= share;
  K_r *= share;
  if (!limited.any()) return {};
  const double damping_left = lag_s_ * std::min(translational_ - K, (rotational_ - K_r) * K / K_r);
  limited.damping = std::clamp(limited.damping, 0.0, std::max(0.0, std::min(damping_left, descriptor_.max_damping)));
  if (limited.max_force > most_N) {
    limited.max_force = most_N;
    reasons.force_limited = HeldSpring(limited, X_WH_).size() >= most_N;
  }
  limited.max_torque = std::clamp(limited.max_torque, 0.0, descriptor_.max_torque);
  return limited;
}

/// Takes as much of the next half-spaces as the rates permit, with the hand where it is now. If their wrench is too far
/// from the last one, the wrench of the last half-spaces falls first. Returns whether they change less than wanted.
bool HalfSpaceLimits::change_softly(double dt) noexcept {
  const HeldSpring last(last_, X_WH_);
  const HeldSpring next(next_, X_WH_);
  const HandWrench before = last.wrench(last.size());
  HalfSpaces unbounded = next_;
  unbounded.max_torque = std::numeric_limits<double>::infinity();
  const HandWrench wanted = HeldSpring(unbounded, X_WH_).wrench(next.size());
  const double f_step = rates_.force_rate() * dt;
  const double t_step = rates_.torque_rate() * dt;
  const Shares of_f = shares_near(wanted.f_H_W, std::numeric_limits<double>::infinity(), before.f_H_W, f_step);
  const Shares of_t = shares_near(wanted.t_H_W, next_.max_torque, before.t_H_W, t_step);
  const double least = std::max({0.0, of_f.least, of_t.least});
  const double most = std::min({1.0, of_f.most, of_t.most});
  if (most == 1.0 && least <= most) return false;
  if (least <= most) {
    next_.max_force = most * next.size();
    return true;
  }
  const auto share_of = [](double step, double norm) { return norm > step ? step / norm : 1.0; };
  const double kept = 1.0 - std::min(share_of(f_step, before.f_H_W.norm()), share_of(t_step, before.t_H_W.norm()));
  next_ = last_;
  next_.max_force = kept * last.size();
  return true;
}

/// Noise within the play is no motion.
void HalfSpaceLimits::observe_rest(const Eigen::Isometry3d& X_WH, double dt) noexcept {
  if (dt <= 0.0) return;
  const geometry::Displacement step = pose_.follow(X_WH);
  const double speed = (step.v.norm() + kEnvelope.lever_m * step.w.norm()) / dt;
  speed_m_per_s_ += std::min(1.0, dt / kEnvelope.rate_averaged_s) * (speed - speed_m_per_s_);
  resting_for_s_ = speed_m_per_s_ < kEnvelope.resting_m_per_s ? resting_for_s_ + dt : 0.0;
}

/// Where the hand goes in the meantime is not always known. What is left of the energy that it had put in comes back.
/// So what it has put in counts where the hand was last.
void HalfSpaceLimits::begin_fade() noexcept {
  if (before_fade_) return;
  before_fade_ = last_;
  left_J_ = stored_energy(last_, X_WH_);
}

double HalfSpaceLimits::take_back() noexcept {
  if (!before_fade_) return 0.0;
  before_fade_.reset();
  return std::max(0.0, left_J_ - stored_energy(last_, X_WH_));
}

}  // namespace glissade::devices
