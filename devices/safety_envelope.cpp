#include <algorithm>
#include <utility>

#include <glissade/devices/safety_envelope.h>

#include "envelope/energy_limit.h"
#include "envelope/envelope_numbers.h"
#include "envelope/fade.h"
#include "envelope/finger_limits.h"
#include "envelope/half_space_limits.h"
#include "envelope/link_delay.h"
#include "envelope/simple_limits.h"
#include "envelope/state_check.h"

namespace glissade::devices {

using std::chrono::nanoseconds;

namespace {

nanoseconds rounded(std::chrono::duration<double> time) {
  return std::chrono::duration_cast<nanoseconds>(time);
}

nanoseconds period_of(const DeviceDescriptor& descriptor, nanoseconds of_caller) {
  validate(descriptor);
  return std::max(of_caller, rounded(std::chrono::duration<double>(1.0 / descriptor.update_rate)));
}

}  // namespace

/// The stages through which a command passes, and what they share.
struct SafetyEnvelope::Stages {
  Stages(const Stages&) = delete;  // they refer to each other
  Stages& operator=(const Stages&) = delete;
  Stages(const DeviceDescriptor& of_device, double patience_periods, nanoseconds period_of_caller)
      : descriptor(of_device),
        period(period_of(of_device, period_of_caller)),
        rates(descriptor, in_seconds(period)),
        check(descriptor, rounded(patience_periods * std::chrono::duration<double>(period))),
        link_delay(in_seconds(period)),
        fade(descriptor, in_seconds(period)),
        norms(descriptor, in_seconds(period)),
        energy(descriptor, rates, period, rounded(patience_periods * std::chrono::duration<double>(period))),
        finger_limits(descriptor, in_seconds(period)),
        half_spaces(descriptor, rates, in_seconds(period)) {
    descriptor.max_force = rates.max_force();
    descriptor.max_torque = rates.max_torque();
  }

  void observe(const GloveState& state, nanoseconds now) noexcept {
    if (const std::optional<BookedMotion> motion = check.observe(state, now)) energy.observe(*motion);
  }

  /// What the hand feels of the commanded and the wanted wrench, and of half-spaces.
  void observe_felt(const Forces& given, double dt) noexcept {
    const auto with = [](Forces forces, const HandWrench& held) {
      forces.f += held.f_H_W;
      forces.t += held.t_H_W;
      return forces;
    };
    const Forces felt = with(given, half_spaces.given_wrench());
    norms.observe_given(felt.f, dt);
    energy.observe_felt(with(wanted, half_spaces.wanted_wrench()), felt);
  }

  double seconds_since_last_call(nanoseconds now) noexcept {
    const nanoseconds passed = has_been_called ? now - last_call : nanoseconds(0);
    has_been_called = true;
    last_call = now;
    if (passed > expiry_of_limits(in_seconds(period))) drop_held();
    return in_seconds(std::clamp(passed, nanoseconds(0), 2 * period));
  }

  /// After so long without a command, the device has dropped its limits and half-spaces. They return as after a fade.
  void drop_held() noexcept {
    const bool dropped_half_spaces = half_spaces.drop();
    const bool dropped_limits = finger_limits.drop();
    if (dropped_half_spaces || dropped_limits) fade.begin_at_zero();
  }

  DeviceDescriptor descriptor;  // with the maxima that the rates lower
  nanoseconds period;
  RateLimit rates;
  StateCheck check;
  LinkDelay link_delay;
  Fade fade;
  NormLimit norms;
  EnergyLimit energy;
  FingerLimits finger_limits;
  HalfSpaceLimits half_spaces;
  nanoseconds answered{0};  // time of the state that the last command answers
  Forces wanted;            // newest finite one
  Forces last;              // always finite
  bool is_stopped = false;
  bool has_been_called = false;
  nanoseconds last_call{0};
};

SafetyEnvelope::SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods,
                               nanoseconds period_of_caller)
    : stages_(std::make_unique<Stages>(descriptor, patience_periods, period_of_caller)) {}

SafetyEnvelope::SafetyEnvelope(SafetyEnvelope&&) noexcept = default;
SafetyEnvelope& SafetyEnvelope::operator=(SafetyEnvelope&&) noexcept = default;
SafetyEnvelope::~SafetyEnvelope() = default;

void SafetyEnvelope::stop() noexcept {
  stages_->is_stopped = true;
}

const DeviceDescriptor& SafetyEnvelope::descriptor() const noexcept {
  return stages_->descriptor;
}

nanoseconds SafetyEnvelope::link_delay() const noexcept {
  return std::max(stages_->link_delay.upper_quartile(), nanoseconds(1));
}

bool SafetyEnvelope::trusts(const GloveState& newest, nanoseconds now) noexcept {
  stages_->observe(newest, now);
  return is_finite(newest) && stages_->check.trusts(now);
}

SafeCommand SafetyEnvelope::limit(const GloveCommand& wanted, const GloveState& newest, nanoseconds now) noexcept {
  Stages& stages = *stages_;
  const double dt = stages.seconds_since_last_call(now);
  stages.observe(newest, now);
  const GloveState& state = stages.check.state();

  SafeCommand safe;
  LimitReasons& reasons = safe.reasons_;
  reasons = stages.check.faults(wanted, newest, stages.link_delay.upper_quartile(), now);
  reasons.is_stopped = stages.is_stopped;
  if (!reasons.not_finite) {
    safe.age_ = stages.check.age_of(wanted.state_time, now);
    safe.state_age_ = stages.check.age_of(state.time, now);
    const bool is_new = std::exchange(stages.answered, wanted.state_time) != wanted.state_time;
    if (is_new) stages.link_delay.observe(safe.age_, dt);
  }
  const bool is_fading = reasons.is_fading();
  if (is_finite(wanted)) {
    stages.wanted = {wanted.f_H_W, wanted.t_H_W, wanted.joint_torques};
    if (stages.half_spaces.are_taken()) stages.wanted.scale_wrench(0.0);
    stages.energy.take_supply(wanted, is_fading, dt);
  }
  stages.fade.advance(is_fading, dt);
  reasons.is_returning = !is_fading && !stages.fade.is_whole();

  Forces forces = is_fading ? stages.fade.fading(stages.last, dt) : stages.wanted;
  stages.norms.limit(forces, reasons);
  if (!is_fading) forces = stages.fade.returning(forces);
  limit_power(forces, state, stages.descriptor.max_power, reasons);
  const HeldEnergy held = stages.half_spaces.want(wanted.half_spaces, state, is_fading, stages.fade,
                                                  stages.norms.largest_force(), dt, reasons);
  stages.energy.settle(forces, held, !stages.fade.is_whole(), now, dt);
  stages.energy.limit(forces, state, stages.last, now, dt, reasons);
  stages.rates.limit(forces, stages.last, dt, reasons);
  const JointLimits& limits =
      stages.finger_limits.limit(wanted.joint_limits, state.joint_angles, is_fading, stages.fade, dt, reasons);
  // Cannot happen; but NaN would pass all limits above, and stay.
  if (!forces.f.allFinite() || !forces.t.allFinite() || !all_finite(forces.joints)) forces = {};
  const double gain = stages.half_spaces.give(is_fading ? 0.0 : stages.energy.available(state), dt, reasons);
  if (!is_fading) stages.energy.pay(gain, state);
  stages.energy.observe_given(forces, now);
  stages.observe_felt(forces, dt);
  stages.last = forces;

  safe.energy_ = stages.energy.energy();
  safe.taken_ = stages.energy.supply().taken();
  safe.values_ = wanted;
  safe.values_.supply = stages.energy.supply().total();
  safe.values_.f_H_W = forces.f;
  safe.values_.t_H_W = forces.t;
  safe.values_.joint_torques = forces.joints;
  safe.values_.joint_limits = limits;
  safe.values_.half_spaces = stages.half_spaces.given();
  if (is_fading && safe.values_.is_at_rest()) stages.fade.begin_at_zero();
  return safe;
}

}  // namespace glissade::devices
