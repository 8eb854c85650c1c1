#include "loop/answer.h"

#include <algorithm>
#include <cmath>

#include "loop/loop_settings.h"

namespace glissade::haptics {

namespace {

Eigen::Isometry3d between(const Eigen::Isometry3d& X_from, const Eigen::Isometry3d& X_to, double share) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  return geometry::displaced(X_from, origin, geometry::displacement_between(X_from, X_to, origin).scaled(share));
}

/// `to`, with what has moved since `from` on its straight way between both.
Ghosts between(const Ghosts& from, const Ghosts& to, double share) {
  Ghosts ghosts = to;
  ghosts.time =
      from.time + std::chrono::nanoseconds(std::llround(share * static_cast<double>((to.time - from.time).count())));
  for (std::size_t p = 0; p < ghosts.parts.size(); ++p) {
    if (to.parts[p].is_held && from.parts[p].hold == to.parts[p].hold)
      ghosts.parts[p].X_WG = between(from.parts[p].X_WG, to.parts[p].X_WG, share);
  }
  for (std::size_t h = 0; h < ghosts.hands.size(); ++h) {
    if (!from.hands[h].is_tracked || !to.hands[h].is_tracked) continue;
    ghosts.hands[h].X_WH = between(from.hands[h].X_WH, to.hands[h].X_WH, share);
    for (std::size_t j = 0; j < ghosts.hands[h].angles.size(); ++j)
      ghosts.hands[h].angles[j] = std::lerp(from.hands[h].angles[j], to.hands[h].angles[j], share);
  }
  return ghosts;
}

grasping::HandTarget target_of(const GhostOfHand& ghost) {
  grasping::HandTarget target;
  if (ghost.is_tracked) target.posture = {ghost.X_WH, {ghost.angles.begin(), ghost.angles.end()}};
  if (ghost.part >= 0) target.part = static_cast<std::size_t>(ghost.part);
  return target;
}

}  // namespace

Answerer::Answerer(grasping::GraspSimulation& simulation)
    : simulation_(simulation),
      sliding_(simulation.parts()),
      calls_before_(sliding_.call_statistics().calls),
      patches_(sliding_),
      X_WG_(simulation.part_count()),
      targets_(simulation.hand_count()) {
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    if (!sliding_.is_scripted(p)) simulation_.leave_part(p);
  }
}

ContactSet Answerer::at_start() {
  ContactSet set;
  set.part_count = static_cast<std::int32_t>(sliding_.part_count());
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    set.parts[p].p_Vref = sliding_.p_Vref(p);
    set.parts[p].X_WV = sliding_.result(p).X_WV;
  }
  tell_hands(set);
  return set;
}

void Answerer::answer(const Ghosts& ghosts, std::chrono::nanoseconds first, ContactSet& set) {
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    const GhostOfPart& ghost = ghosts.parts[p];
    if (sliding_.is_scripted(p) || ghost.hold == holds_[p]) continue;
    if (ghost.release > holds_[p]) simulation_.leave_part(p);
    if (ghost.is_held) simulation_.take_part(p, ghost.X_WG);
    holds_[p] = ghost.hold;
  }
  // An answer that takes long must not slow the parts down: the slew is a speed.
  const std::chrono::nanoseconds passed = answered_ ? ghosts.time - answered_->time : first;
  const double milliseconds =
      std::clamp(std::chrono::duration<double, std::milli>(passed).count(), 0.0, kLoop.longest_catch_up_ms);
  const double steps = answered_ ? std::clamp(std::floor(milliseconds / kLoop.step_ms), 1.0, kLoop.most_steps) : 1.0;
  const std::int64_t ended_early = sliding_.call_statistics().ended_early;
  double step = 1.0;
  // Where the work of one step is as much as a call may do, more steps would make the next call later still.
  for (; step < steps && sliding_.call_statistics().ended_early == ended_early; ++step)
    advance(between(*answered_, ghosts, step / steps), milliseconds / steps);
  advance(ghosts, milliseconds * (steps - step + 1.0) / steps);
  answered_ = ghosts;
  ++sequence_;
  renew_contact_set(sliding_, sequence_, time_of_answered(), scratch_, set);
  for (std::size_t p = 0; p < sliding_.part_count(); ++p)
    set.parts[p].hold = holds_[p];
  patches_.tell(set);
  tell_hands(set);
}

void Answerer::advance(const Ghosts& ghosts, double milliseconds) {
  for (std::size_t p = 0; p < X_WG_.size(); ++p)
    X_WG_[p] = ghosts.parts[p].X_WG;
  for (std::size_t h = 0; h < targets_.size(); ++h)
    targets_[h] = target_of(ghosts.hands[h]);
  simulation_.advance(X_WG_, targets_, milliseconds);
  ++calls_;
  times_[static_cast<std::size_t>(calls_) % times_.size()] = ghosts.time;
}

void Answerer::tell_hands(ContactSet& set) {
  for (std::size_t h = 0; h < targets_.size(); ++h)
    fingers_.tell(simulation_, h, set.hands[h]);
}

std::chrono::nanoseconds Answerer::time_of_answered() const {
  const std::int64_t oldest = std::max<std::int64_t>(1, calls_ - std::ssize(times_) + 1);
  const std::int64_t answered = std::clamp(sliding_.answered_call() - calls_before_, oldest, calls_);
  return times_[static_cast<std::size_t>(answered) % times_.size()];
}

}  // namespace glissade::haptics
