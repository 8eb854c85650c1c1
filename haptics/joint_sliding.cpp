#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glissade/collision/rigid_pose.h>
#include <glissade/haptics/joint_sliding.h>

#include "sliding_constants.h"

namespace glissade::haptics {
namespace {

constexpr double kSmallestReach_m = 30e-6;
constexpr double kTicksAhead = 6.0;  // of the ghosts' motion
constexpr double kLeastLookAhead_m = 45e-6;
constexpr double kSmallestReachLimit_m = 1e-3;
constexpr std::size_t kAffordablePairs = 30'000;

constexpr int kDampings = 4;
constexpr double kLargestDamping = 1e3;

constexpr CouplingStiffness kImmovable{kUnbounded, kUnbounded};

}  // namespace

void JointSliding::grasp(std::size_t part, const Eigen::Isometry3d& X_WG) {
  const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG);
  if (!rigid) return;
  Part& held = parts_[part];
  held.result.X_WG = *rigid;
  const bool holds_on = is_held(held) && held.metaphor == Metaphor::kForceFeedback;  // with what lag there is
  if (!holds_on) let_rest(held, SlidingState::kFree);
  if (held.metaphor == Metaphor::kForceFeedback)
    held.offset = displacement_between(*rigid, held.result.X_WT, held.part_V->p_Vref());
}

void JointSliding::release(std::size_t part) {
  parts_[part].result.X_WG = parts_[part].result.X_WV;
  let_rest(parts_[part], SlidingState::kReleased);
}

/// Nothing is wanted of the part, so nothing pushes it.
void JointSliding::let_rest(Part& part, SlidingState state) {
  part.result.X_WT = part.result.X_WV;
  part.X_WA = part.result.X_WV;
  part.lag_then = {};
  part.offset = {};
  part.closing = 0.0;
  part.anti_jam = AntiJam(part.part_V->radius());
  pushed_.clear();
  part.result.state = state;
  part.result.contacts.clear();
  part.result.pushing = 0;
  part.result.cycles = 0;
}

void JointSliding::advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  if (!take_ghosts(X_WG, milliseconds)) return;
  lead_out(kSlew_m * milliseconds);
  int cycles = 1;
  for (;; ++cycles) {
    const Step step = cycle();
    aim();
    const bool all_arrived = std::all_of(step.arrives.begin(), step.arrives.begin() + std::ssize(parts_),
                                         [](bool arrives) { return arrives; });
    if (all_arrived || step.length < kNotWorthIt * largest_margin_ || cycles == rules_.max_cycles) break;
  }
  hand_out_contacts();
  for (Part& part : parts_) {
    if (!is_held(part)) continue;
    part.result.cycles = cycles;
    // Of several parts the contacts are told for where the last step has led.
    part.result.reach = parts_.size() == 1 ? reach_ : std::max(0.0, reach_ - last_step_);
    part.result.state = classify(part);
    part.lag_then = lag_of(part);
    if (!is_shaken(part)) continue;
    part.anti_jam.observe(part.lag_then, part.moved, part.result.pushing > 0, milliseconds);
  }
}

/// Takes the poses that are poses, for parts that are held. False when there is none.
bool JointSliding::take_ghosts(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  bool any = false;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    part.moved = 0.0;
    part.ghost_motion = 0.0;
    part.X_WV_before_last = std::exchange(part.X_WV_before, part.result.X_WV);
    part.X_WG_then = part.result.X_WG;
    const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG[p]);
    if (!is_held(part) || !rigid) continue;
    any = true;
    part.result.X_WG = *rigid;
    part.ghost_motion =
        motion_bound(displacement_between(part.X_WG_then, *rigid, part.part_V->p_Vref()), part.part_V->radius());
    close_offset(part, kClosing_m * milliseconds);
    const Eigen::Vector3d& p_Vref = part.part_V->p_Vref();
    part.result.X_WT = wanted_pose(part.metaphor, part.result.X_WV, part.X_WG_then, *rigid, p_Vref);
    if (!part.offset.is_zero()) part.result.X_WT = displaced(*rigid, p_Vref, part.offset);
    part.X_WA = is_shaken(part) ? part.anti_jam.aim(part.result.X_WT, p_Vref) : part.result.X_WT;
  }
  // A part may be pushed by another as fast as the ghost of that one goes.
  const double ghosts = std::accumulate(parts_.begin(), parts_.end(), 0.0,
                                        [](double sum, const Part& part) { return sum + part.ghost_motion; });
  for (Part& part : parts_) {
    part.slew = part.metaphor == Metaphor::kForceFeedback ? kSlew_m * milliseconds + ghosts : kUnbounded;
  }
  return any;
}

/// By at most so many metres for any point of the part.
void JointSliding::close_offset(Part& part, double most) const {
  const double left = part.offset.v.norm() + part.part_V->radius() * part.offset.w.norm();
  part.closing = std::min(left, most);
  part.offset = part.closing < left ? part.offset.scaled(1.0 - part.closing / left) : Displacement{};
}

/// Aims parts that overlap something out of it, at most so many metres.
void JointSliding::lead_out(double most) {
  led_out_ = 0.0;
  if (overlaps_.empty()) return;
  if (overlaps_.update()) candidates_.clear();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const WayOut* way = overlaps_.way_out_of(p);
    if (way == nullptr || !is_held(parts_[p])) continue;
    parts_[p].X_WA = parts_[p].result.X_WV;
    parts_[p].X_WA.translation() += std::min(most, way->depth) * way->n_W;
    led_out_ = most;
  }
}

/// The rubber band wants what turns with the part.
void JointSliding::aim() {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    if (!is_held(part) || part.metaphor != Metaphor::kRubberBand || overlaps_.way_out_of(p) != nullptr) continue;
    const Eigen::Vector3d& p_Vref = part.part_V->p_Vref();
    part.result.X_WT = wanted_pose(part.metaphor, part.result.X_WV, part.X_WG_then, part.result.X_WG, p_Vref);
    part.X_WA = is_shaken(part) ? part.anti_jam.aim(part.result.X_WT, p_Vref) : part.result.X_WT;
  }
}

/// One cycle: look around, project, prove, move.
JointSliding::Step JointSliding::cycle() {
  reach_ = choose_reach();
  look_around();
  find_rows();

  Displacements wanted;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    grips_[p] = is_held(part) ? part.stiffness : kImmovable;
    if (!is_held(part)) continue;
    wanted[p] = displacement_between(part.result.X_WV, part.X_WA, part.part_V->p_Vref());
  }
  // A step that gains energy beyond this went over a bend of the contact that the projection did not see, and is tried
  // again with damping.
  const double most_energy = energy(wanted) + allowance(wanted);
  for (int trial = 0; trial < kDampings; ++trial) {
    Displacements damped;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      damped[p] = wanted[p].scaled(1.0 / (1.0 + damping_));
    Step step = certified_step({damped.data(), parts_.size()});
    bool all_arrive = true;
    Displacements remaining;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      step.arrives[p] = step.arrives[p] && damping_ == 0.0;
      all_arrive = all_arrive && step.arrives[p];
      if (!is_held(part)) continue;
      const Eigen::Vector3d& p_Vref = part.part_V->p_Vref();
      remaining[p] =
          displacement_between(displaced(part.result.X_WV, p_Vref, step.displacements[p]), part.X_WA, p_Vref);
    }
    if (all_arrive || energy(remaining) <= most_energy) {
      damping_ = damping_ < 0.1 ? 0.0 : 0.25 * damping_;
      apply(step);
      return step;
    }
    damping_ = std::clamp(4.0 * damping_, 0.5, kLargestDamping);
  }
  damping_ = 0.0;
  const Step none{.clipped = true};
  apply(none);
  return none;
}

/// A search looks some ticks ahead. Where finely cut surfaces lie close there are very many pairs, and a part that
/// falls behind would look further with every search and so fall behind more; the limit on the reach ends that.
void JointSliding::look_around() {
  double ghosts = 0.0;
  for (const Part& part : parts_)
    ghosts += part.ghost_motion + part.closing;
  const double ahead = std::clamp(kTicksAhead * ghosts, kLeastLookAhead_m, kMostLookAhead_m);
  if (!candidates_.look(reach_, ahead, overlaps_.pairs())) return;
  raise_floors();
  const bool too_many = candidates_.size() > kAffordablePairs;
  reach_limit_ = std::clamp((too_many ? 0.5 : 1.25) * reach_limit_, kSmallestReachLimit_m, kLargestReach_m);
}

double JointSliding::choose_reach() const {
  double ghosts = 0.0;
  double slew = 0.0;
  for (const Part& part : parts_) {
    ghosts += part.ghost_motion + part.closing;
    slew = std::max(slew, part.slew);
  }
  double reach = 1.5 * std::max(ghosts, last_step_) + 2.0 * largest_margin_;
  if (last_clipped_) reach *= 2.0;
  reach = std::max(reach, led_out_ + 2.0 * largest_margin_);
  return std::clamp(std::min(reach, slew + ghosts + 2.0 * largest_margin_), kSmallestReach_m, reach_limit_);
}

double JointSliding::energy(std::span<const Displacement> errors) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const CouplingStiffness& k = parts_[p].stiffness;
    sum += 0.5 * (k.translational * errors[p].v.squaredNorm() + k.rotational * errors[p].w.squaredNorm());
  }
  return sum;
}

/// What contacts may cost that ask for their margin back.
double JointSliding::allowance(std::span<const Displacement> errors) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!is_held(parts_[p])) continue;
    const CouplingStiffness& k = parts_[p].stiffness;
    const double squared_pull =
        k.translational * (k.translational * errors[p].v.squaredNorm() + k.rotational * errors[p].w.squaredNorm());
    sum += 2.0 * largest_margin_ * std::sqrt(squared_pull) + k.translational * largest_margin_ * largest_margin_;
  }
  return sum;
}

void JointSliding::apply(const Step& step) {
  const std::size_t found = contacts_.size();
  pushed_.clear();
  for (const RowForce& force : forces_) {
    const auto row = static_cast<std::size_t>(force.row);
    // A row that only a failed proof asked for holds the part like any contact, and is told like one.
    Contact& contact = row < found ? contacts_[row] : contacts_.emplace_back(proof_contacts_[row - found]);
    contact.force = force.normal;
    contact.friction_W = force.across_W;
    if (rules_.friction.is_on()) pushed_.push_back(contact);
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    if (!is_held(part)) continue;
    // An arrival copies the pose that was aimed at, so that the coupling wrench is zero and not merely small.
    // Standing still keeps every bit.
    if (step.arrives[p]) {
      part.result.X_WV = part.X_WA;
    } else if (step.lengths[p] > 0.0) {
      part.result.X_WV = displaced(part.result.X_WV, part.part_V->p_Vref(), step.displacements[p]);
    }
    part.moved += step.lengths[p];
    if (step.lengths[p] > 0.0 || step.arrives[p]) surroundings_.place(p, part.result.X_WV);
  }
  candidates_.moved();
  last_step_ = step.length;
  last_clipped_ = step.clipped;
}

/// To each part its own, as it sees them.
void JointSliding::hand_out_contacts() {
  const auto obstacles = static_cast<std::int32_t>(surroundings_.obstacles().size());
  for (const WayOut& way : overlaps_.ways_out()) {
    Contact& contact = contacts_.emplace_back();
    contact.kind = ContactKind::kOverlap;
    contact.part = way.bodies.part - obstacles;
    contact.obstacle = way.bodies.obstacle;
    contact.n_W = way.n_W;
    const Part& part = parts_[static_cast<std::size_t>(contact.part)];
    contact.p_W = part.result.X_WV_of_contacts * part.part_V->p_Vref();
    contact.gap = -way.depth;
  }
  if (parts_.size() == 1) {
    std::swap(parts_.front().result.contacts, contacts_);
  } else {
    // Each result tells one pose of the contacts, that of its part; so the other side must be where it is now.
    std::array<Eigen::Isometry3d, kMaxParts> motions;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      SlidingResult& result = parts_[p].result;
      motions[p] = result.X_WV * result.X_WV_of_contacts.inverse(Eigen::Isometry);
      result.X_WV_of_contacts = result.X_WV;
      result.contacts.clear();
    }
    for (const Contact& found : contacts_) {
      const auto number = static_cast<std::size_t>(found.part);
      const std::int32_t other = found.obstacle - obstacles;
      const Contact contact = other < 0 ? carried(found, motions[number])
                                        : carried(found, motions[number], motions[static_cast<std::size_t>(other)]);
      parts_[number].result.contacts.push_back(contact);
      if (other < 0) continue;
      parts_[static_cast<std::size_t>(other)].result.contacts.push_back(
          mirrored(contact, static_cast<std::int32_t>(surroundings_.body_of_part(number)), other));
    }
  }
  for (Part& part : parts_) {
    const std::vector<Contact>& contacts = part.result.contacts;
    part.result.pushing = static_cast<int>(
        std::count_if(contacts.begin(), contacts.end(), [](const Contact& contact) { return contact.force > 0.0; }));
    if (is_held(part)) continue;
    part.result.contacts.clear();
    part.result.pushing = 0;
  }
}

SlidingState JointSliding::classify(const Part& part) const {
  if (part.result.X_WV.matrix() == part.result.X_WT.matrix()) return SlidingState::kFree;
  if (part.result.pushing == 0) return SlidingState::kCatchingUp;
  return part.moved > kNotWorthIt * part.margin ? SlidingState::kSliding : SlidingState::kResting;
}

}  // namespace glissade::haptics
