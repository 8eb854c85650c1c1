#include "envelope/state_check.h"

#include <algorithm>
#include <cmath>

#include "envelope/envelope_numbers.h"
#include "envelope/envelope_settings.h"

namespace glissade::devices {

namespace {

using std::chrono::nanoseconds;

double angle_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) noexcept {
  const double cosine = 0.5 * ((A.transpose() * B).trace() - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

std::optional<BookedMotion> StateCheck::observe(const GloveState& state, nanoseconds now) noexcept {
  if (!is_finite(state)) {
    distrust_until_ = now + kEnvelope.distrust;
    return std::nullopt;
  }
  const bool is_new = !has_state_ || state.sequence != state_.sequence || state.time != state_.time;
  if (!is_new) return std::nullopt;
  const bool plausible = is_plausible(state);
  if (!plausible) distrust_until_ = now + kEnvelope.distrust;
  const bool catches_up = !plausible && may_have_gone_to(state);
  clock_.observe(state.time, now);
  const nanoseconds measured = state.time + clock_.value();
  // Where the clock does not go on, the way counts once it does. After a jump that may be the way of a hand whose pose
  // stood still for a while, it counts once the states are plausible again.
  const bool goes_on = has_state_ && (plausible || catches_up) && state.time >= booked_.time;
  const bool counts = goes_on && plausible && measured > booked_at_;
  std::optional<BookedMotion> motion;
  if (counts) motion = {booked_, state, booked_at_, measured, has_caught_up_};
  has_caught_up_ = goes_on && !counts && (has_caught_up_ || catches_up);
  if (!goes_on || counts) {
    booked_ = state;
    booked_at_ = measured;
    if (!plausible) booked_.v_WH = booked_.w_WH = Eigen::Vector3d::Zero();  // they may be the error
  }
  const bool repeats = has_state_ && state.X_WH.matrix() == state_.X_WH.matrix();
  if (!repeats) pose_time_ = state.time;
  state_ = state;
  has_state_ = true;
  return motion;
}

bool StateCheck::is_plausible(const GloveState& state) const noexcept {
  if (state.v_WH.norm() > descriptor_.max_speed || state.w_WH.norm() > descriptor_.max_turn_rate) return false;
  if (state.X_WH.translation().norm() > descriptor_.workspace_radius) return false;
  if (!has_state_) return true;  // nothing to compare with
  if (state.time < state_.time) return false;
  if (descriptor_.frozen > nanoseconds(0) && state.X_WH.matrix() == state_.X_WH.matrix() &&
      state.time - pose_time_ > descriptor_.frozen) {
    return false;
  }
  const double dt = in_seconds(state.time - state_.time);
  const Eigen::Vector3d moved = state.X_WH.translation() - state_.X_WH.translation();
  if (moved.norm() > descriptor_.max_speed * dt + kEnvelope.jump_tolerance_m) return false;
  const double turned = angle_between(state_.X_WH.linear(), state.X_WH.linear());
  if (turned > descriptor_.max_turn_rate * dt + kEnvelope.turn_tolerance_rad) return false;
  const Eigen::Vector3d unexplained = moved - 0.5 * dt * (state.v_WH + state_.v_WH);
  return unexplained.norm() <= kEnvelope.speed_mismatch * descriptor_.max_speed * dt + kEnvelope.jump_tolerance_m;
}

/// Whether the hand may have gone to this pose: while the last one repeated to the bit, of which 0.1 s counts; or since
/// the last state, if it is a few times as fast as the descriptor tells.
bool StateCheck::may_have_gone_to(const GloveState& state) const noexcept {
  if (!has_state_ || state.time < state_.time) return false;
  const double way = (state.X_WH.translation() - state_.X_WH.translation()).norm();
  const double repeated_s = std::min(in_seconds(state.time - pose_time_), kEnvelope.longest_repeat_s);
  const double seconds = std::max(repeated_s, kEnvelope.much_faster * in_seconds(state.time - state_.time));
  return way <= descriptor_.max_speed * seconds + kEnvelope.jump_tolerance_m;
}

LimitReasons StateCheck::faults(const GloveCommand& wanted, const GloveState& newest, nanoseconds link_delay,
                                nanoseconds now) const noexcept {
  LimitReasons reasons;
  reasons.is_disabled = !newest.is_enabled;
  reasons.is_refused = newest.obeys_another;
  reasons.not_finite = !is_finite(wanted) || !is_finite(newest);
  reasons.is_implausible = now < distrust_until_;
  if (reasons.not_finite) return reasons;  // no ages are known
  reasons.is_state_old = age_of(state_.time, now) > patience_;
  const bool is_from_future = wanted.state_time > state_.time;
  // A command whose age does not count as a delay of the link must not act: its spring would be too stiff.
  const nanoseconds oldest = std::min<nanoseconds>(link_delay + patience_, kEnvelope.longest_delay);
  reasons.is_command_old = !reasons.is_state_old && (is_from_future || age_of(wanted.state_time, now) > oldest);
  return reasons;
}

}  // namespace glissade::devices
