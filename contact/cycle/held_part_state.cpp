#include "cycle/held_part_state.h"

#include <algorithm>
#include <utility>

#include <glissade/contact/sliding_rules.h>

#include "cycle/sliding_constants.h"

namespace glissade::contact {

geometry::Displacement HeldPartState::lag() const {
  return geometry::displacement_between(result.X_WV, result.X_WT, p_Vref);
}

void HeldPartState::rest(SlidingState state) {
  result.X_WT = result.X_WV;
  X_WS = result.X_WV;
  previous_lag = {};
  offset = {};
  closing = 0.0;
  spiral_search = SpiralSearch(part_V->radius());
  rest_watch = {};
  result.state = state;
  result.contacts.clear();
  result.pushing = 0;
  result.cycles = 0;
}

void HeldPartState::grasp(const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref_of_hold) {
  result.X_WG = X_WG;
  if (!is_held() || !traits_of(metaphor).limits_speed) {
    p_Vref = p_Vref_of_hold;
    rest(SlidingState::kFree);
  } else {
    move_reference(p_Vref_of_hold);
  }
  if (traits_of(metaphor).limits_speed) offset = geometry::displacement_between(X_WG, result.X_WT, p_Vref);
}

/// The lag about the new point is that which exerts the same wrench, so contacts hold the part where it is. Where that
/// would turn the part's target too far to say in which direction, the wrench is smaller.
void HeldPartState::move_reference(const Eigen::Vector3d& p_Vref_to) {
  constexpr double kMostTurn_rad = 1.0;
  if (p_Vref_to == p_Vref) return;
  const Wrench wrench = about_point(spring_wrench(stiffness, lag()), p_Wref(), result.X_WV * p_Vref_to);
  const geometry::Displacement lag_there{-wrench.f / stiffness.translational, -wrench.t / stiffness.rotational};
  const double turn = lag_there.w.norm();
  p_Vref = p_Vref_to;
  result.X_WT = geometry::displaced(result.X_WV, p_Vref,
                                    turn > kMostTurn_rad ? lag_there.scaled(kMostTurn_rad / turn) : lag_there);
  previous_lag = lag();
  aim();
}

void HeldPartState::begin_tick() {
  moved = 0.0;
  ghost_motion = 0.0;
  X_WV_before_last = std::exchange(X_WV_before, result.X_WV);
  X_WG_previous = result.X_WG;
}

void HeldPartState::follow(const Eigen::Isometry3d& X_WG, double milliseconds) {
  result.X_WG = X_WG;
  ghost_motion = geometry::motion_bound(geometry::displacement_between(X_WG_previous, X_WG, p_Vref), lever);
  const double left = offset.v.norm() + part_V->radius() * offset.w.norm();
  closing = std::min(left, kClosing_m * milliseconds);
  offset = closing < left ? offset.scaled(1.0 - closing / left) : geometry::Displacement{};
  result.X_WT = wanted_pose(metaphor, result.X_WV, X_WG_previous, X_WG, p_Vref);
  if (!offset.is_zero()) result.X_WT = geometry::displaced(X_WG, p_Vref, offset);
  aim();
}

void HeldPartState::turn_target() {
  if (traits_of(metaphor).turns_part) return;
  result.X_WT = wanted_pose(metaphor, result.X_WV, X_WG_previous, result.X_WG, p_Vref);
  aim();
}

void HeldPartState::aim() {
  X_WS = may_search ? spiral_search.aim(result.X_WT, p_Vref) : result.X_WT;
}

void HeldPartState::end_cycle(int number, double reach) {
  result.cycles = number;
  result.reach = reach;
  result.state = classify();
}

void HeldPartState::end_tick(double milliseconds) {
  previous_lag = lag();
  rest_watch.observe(result.X_WV, X_WS, p_Vref, lever, moved > kNotWorthIt * margin, milliseconds);
  if (may_search) spiral_search.observe(result.X_WT, p_Vref, previous_lag, moved, result.pushing > 0, milliseconds);
}

SlidingState HeldPartState::classify() const {
  if (result.X_WV.matrix() == result.X_WT.matrix()) return SlidingState::kFree;
  if (result.pushing == 0) return SlidingState::kCatchingUp;
  return moved > kNotWorthIt * margin ? SlidingState::kSliding : SlidingState::kResting;
}

}  // namespace glissade::contact
