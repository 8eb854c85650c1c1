#include "paper/paper_sliding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glissade/base/assert.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

namespace glissade::reference {
namespace {

constexpr double kLeastBracket_m = 1e-9;  // bisection ends far above rounding
constexpr double kNoProgress = 1.0;       // brackets: less motion counts as none
constexpr double kRoom = 0.5;             // brackets: contacts that are nearer demand this distance

contact::ContactKind contact_kind_of(PaperContactKind kind) {
  switch (kind) {
    case PaperContactKind::kVertexFace:
      return contact::ContactKind::kVertexFace;
    case PaperContactKind::kFaceVertex:
      return contact::ContactKind::kFaceVertex;
    case PaperContactKind::kEdgeEdge:
      return contact::ContactKind::kEdgeEdge;
    case PaperContactKind::kUnclear:
      break;
  }
  return contact::ContactKind::kVertexVertex;
}

}  // namespace

PaperSliding::PaperSliding(std::vector<contact::Obstacle> obstacles, std::shared_ptr<const contact::SlidingPart> part_V,
                           const Eigen::Isometry3d& X_WV_start, const PaperSlidingOptions& options)
    : collision_object_(std::move(obstacles), std::move(part_V)),
      stiffness_(options.stiffness.value_or(contact::stiffness_of_part(part().radius()))),
      metaphor_(options.metaphor),
      bracket_(options.bracket),
      max_cycles_(options.max_cycles) {
  if (!(bracket_ >= kLeastBracket_m)) {
    throw std::invalid_argument("a bracket of " + std::to_string(1e9 * bracket_) + " nm is less than a nanometre");
  }
  validate(stiffness_, "the part");
  const std::optional<Eigen::Isometry3d> X_WV = geometry::rigid_pose(X_WV_start);
  if (!X_WV) throw std::invalid_argument("the start pose of the part is not a rotation and translation");
  if (const int hit = collision_object_.obstacle_hit_at(*X_WV); hit >= 0) {
    const std::string& name = collision_object_.obstacles()[static_cast<std::size_t>(hit)].name;
    throw std::invalid_argument("the part collides with " + name + " at its start pose");
  }
  result_.X_WG = *X_WV;
  result_.X_WT = *X_WV;
  result_.X_WV = *X_WV;
}

void PaperSliding::grasp(const Eigen::Isometry3d& X_WG) {
  const std::optional<Eigen::Isometry3d> rigid = geometry::rigid_pose(X_WG);
  if (!rigid) return;
  result_.X_WG = *rigid;
  let_rest(contact::SlidingState::kFree);
}

void PaperSliding::release() {
  result_.X_WG = result_.X_WV;
  let_rest(contact::SlidingState::kReleased);
}

/// The target is the pose of the part itself, so nothing pushes it.
void PaperSliding::let_rest(contact::SlidingState state) {
  result_.X_WT = result_.X_WV;
  result_.state = state;
  result_.contacts.clear();
  result_.pushing = 0;
  result_.cycles = 0;
  states_.clear();
}

const contact::SlidingResult& PaperSliding::advance(const Eigen::Isometry3d& X_WG_given, double milliseconds) {
  GLISSADE_ASSERT(milliseconds >= 0.0 && std::isfinite(milliseconds));
  const std::optional<Eigen::Isometry3d> rigid = geometry::rigid_pose(X_WG_given);
  if (!rigid || result_.state == contact::SlidingState::kReleased) return result_;
  X_WG_previous_ = result_.X_WG;
  result_.X_WG = *rigid;
  want();
  const double ghost_motion =
      geometry::motion_bound(geometry::displacement_between(X_WG_previous_, *rigid, part().p_Vref()), part().radius());
  budget_ = traits_of(metaphor_).limits_speed ? contact::kSlew_m * milliseconds + 2.0 * ghost_motion
                                              : std::numeric_limits<double>::infinity();
  moved_ = 0.0;
  moved_in_cycle_ = 0.0;
  stalled_cycles_ = 0;
  contacts_.clear();
  result_.cycles = 0;
  states_.clear();
  for (PaperState state = PaperState::kMoving; state != PaperState::kDone; state = next_state(state, work(state)))
    states_.push_back(state);
  states_.push_back(PaperState::kDone);
  report_contacts();
  result_.state = summary();
  return result_;
}

void PaperSliding::want() {
  result_.X_WT = contact::wanted_pose(metaphor_, result_.X_WV, X_WG_previous_, result_.X_WG, part().p_Vref());
}

PaperEvent PaperSliding::work(PaperState state) {
  switch (state) {
    case PaperState::kMoving:
      return go(lag());
    case PaperState::kBisecting:
      return bisect();
    case PaperState::kClassifying:
      return classify();
    case PaperState::kNewDirection:
      return choose_direction();
    case PaperState::kCriterion:
      return evaluate_criterion();
    case PaperState::kSliding:
      return go(direction_);
    case PaperState::kDone:
      break;
  }
  return PaperEvent::kStop;
}

/// Moves the collision object, and the visible one after it where it is free.
PaperEvent PaperSliding::go(const geometry::Displacement& displacement) {
  const double fraction = geometry::fraction_within(displacement, part().radius(), budget_);
  attempt_ = displacement.scaled(fraction);
  const bool whole_way = fraction == 1.0 && states_.back() == PaperState::kMoving;
  // An arrival copies the wanted pose, so that the coupling wrench is zero and not merely small.
  X_WC_ = whole_way ? result_.X_WT : geometry::displaced(result_.X_WV, part().p_Vref(), attempt_);
  if (collision_object_.collides(X_WC_)) return PaperEvent::kCollision;
  place_visible(X_WC_, geometry::motion_bound(attempt_, part().radius()));
  return PaperEvent::kFree;
}

/// Interval bisection between the visible object, which is free, and the collision object, which is not.
PaperEvent PaperSliding::bisect() {
  ++result_.cycles;
  const double length = attempt_.v.norm() + attempt_.w.norm() * part().radius();
  double free = 0.0;
  double colliding = 1.0;
  Eigen::Isometry3d X_WV = result_.X_WV;
  while ((colliding - free) * length > bracket_) {
    const double middle = 0.5 * (free + colliding);
    const Eigen::Isometry3d X_WC = geometry::displaced(result_.X_WV, part().p_Vref(), attempt_.scaled(middle));
    if (collision_object_.collides(X_WC)) {
      colliding = middle;
      X_WC_ = X_WC;
    } else {
      free = middle;
      X_WV = X_WC;
    }
  }
  if (free > 0.0) place_visible(X_WV, geometry::motion_bound(attempt_.scaled(free), part().radius()));
  return PaperEvent::kWorked;
}

void PaperSliding::place_visible(const Eigen::Isometry3d& X_WV, double length) {
  result_.X_WV = X_WV;
  budget_ -= length;
  moved_ += length;
  moved_in_cycle_ += length;
  if (!traits_of(metaphor_).turns_part) want();  // its target turns with the part
}

/// Drops contacts that the part has left. A contact that is found again replaces the old one.
PaperEvent PaperSliding::classify() {
  std::erase_if(contacts_, [&](const PaperContact& c) { return c.gap_at(result_.X_WV) > held_within(); });
  collision_object_.touching_pairs(X_WC_, touching_);
  found_.clear();
  classify_contacts(collision_object_.obstacles(), part(), touching_, X_WC_, result_.X_WV, held_within(), found_);
  found_.insert(found_.end(), contacts_.begin(), contacts_.end());
  keep_first_of_each(found_);
  found_contact_ = found_.size() > contacts_.size();
  contacts_.swap(found_);
  return PaperEvent::kWorked;
}

/// Tries a direction with rotation first. A rotation can end at once at the contacts about which it turns, because the
/// curvature of its path soon uses up the room of a bracket; the next cycle then omits it. A contact that the part
/// touches up to rounding would stop all motion. Therefore contacts demand half a bracket of room (ours), unless these
/// demands contradict each other.
PaperEvent PaperSliding::choose_direction() {
  const bool progress = moved_in_cycle_ >= kNoProgress * bracket_ || found_contact_;
  stalled_cycles_ = progress ? 0 : stalled_cycles_ + 1;
  moved_in_cycle_ = 0.0;
  if (stalled_cycles_ == 0) {
    const std::optional<geometry::Displacement> with_room =
        new_motion(lag(), stiffness_, contact_rows(kRoom * bracket_), solver_);
    direction_ = with_room
                     ? *with_room
                     : new_motion(lag(), stiffness_, contact_rows(0.0), solver_).value_or(geometry::Displacement{});
  } else {
    normals_.clear();
    for (const PaperContact& contact : contacts_)
      normals_.push_back(contact.n_W);
    direction_ = {new_translation(lag().v, normals_).v, Eigen::Vector3d::Zero()};
  }
  return PaperEvent::kWorked;
}

/// The criterion has the number of iterations and three distances: the motion of this cycle, the length of the new
/// direction, and the motion that the metaphor's speed still allows.
PaperEvent PaperSliding::evaluate_criterion() {
  const double least = kNoProgress * bracket_;
  const bool stop = result_.cycles >= max_cycles_ || stalled_cycles_ > 1 ||
                    geometry::motion_bound(direction_, part().radius()) < least || budget_ < least;
  return stop ? PaperEvent::kStop : PaperEvent::kGoOn;
}

/// Rows of the contacts; those nearer than `room` (metres) demand it.
std::span<const contact::ConstraintRow> PaperSliding::contact_rows(double room) {
  const Eigen::Vector3d p_Wref = result_.X_WV * part().p_Vref();
  rows_.clear();
  for (const PaperContact& contact : contacts_)
    rows_.push_back(
        {contact.n_W, result_.X_WV * contact.p_V - p_Wref, std::clamp(room - contact.gap_at(result_.X_WV), 0.0, room)});
  return rows_;
}

void PaperSliding::report_contacts() {
  std::erase_if(contacts_, [&](const PaperContact& c) { return c.gap_at(result_.X_WV) > held_within(); });
  result_.contacts.clear();
  for (const PaperContact& contact : contacts_) {
    contact::Contact reported{};
    reported.kind = contact_kind_of(contact.features.kind);
    if (contact.features.kind != PaperContactKind::kUnclear) {
      reported.part_feature = contact.features.of_part;
      reported.obstacle_feature = contact.features.of_obstacle;
    }
    reported.part_triangle = contact.part_triangle;
    reported.obstacle = contact.features.obstacle;
    reported.obstacle_triangle = contact.obstacle_triangle;
    reported.n_W = contact.n_W;
    reported.p_W = result_.X_WV * contact.p_V;
    reported.gap = std::max(contact.gap_at(result_.X_WV), std::numeric_limits<double>::min());
    reported.margin = margin();
    result_.contacts.push_back(reported);
  }
  const contact::Projection<1> shares = solver_.project(lag(), stiffness_, contact_rows(0.0));
  result_.pushing = shares.status == contact::ProjectionStatus::kSolved ? shares.active_count : 0;
  for (int i = 0; i < result_.pushing; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    result_.contacts[static_cast<std::size_t>(shares.active[slot])].force = shares.force[slot];
  }
  result_.X_WV_of_contacts = result_.X_WV;
  result_.reach = held_within();
}

std::string PaperSliding::trace() const {
  std::string names;
  for (const PaperState state : states_)
    names += (names.empty() ? "" : ">") + std::string(name_of(state));
  return names;
}

contact::SlidingState PaperSliding::summary() const {
  if (result_.X_WV.matrix() == result_.X_WT.matrix()) return contact::SlidingState::kFree;
  if (result_.pushing == 0) return contact::SlidingState::kCatchingUp;
  return moved_ > bracket_ ? contact::SlidingState::kSliding : contact::SlidingState::kResting;
}

}  // namespace glissade::reference
