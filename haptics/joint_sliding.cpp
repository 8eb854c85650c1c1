#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <glissade/collision/rigid_pose.h>
#include <glissade/haptics/contact_search.h>
#include <glissade/haptics/joint_sliding.h>

namespace glissade::haptics {
namespace {

constexpr double kDefaultStiffness_N_per_m = 1000.0;
constexpr double kSmallestReach_m = 30e-6;
constexpr double kLargestReach_m = 3e-3;
constexpr double kMostLookAhead_m = 0.5e-3;
constexpr double kSmallestReachLimit_m = 1e-3;
constexpr std::size_t kAffordablePairs = 30'000;

constexpr int kProjections = 4;  // the first, and three more with rows for what could not be proved
constexpr int kHalvings = 6;
constexpr int kDampings = 4;
constexpr double kLargestDamping = 1e3;
constexpr double kNotWorthIt = 0.05;  // a step below this part of the margin ends the cycles

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr CouplingStiffness kImmovable{kUnbounded, kUnbounded};

CouplingStiffness default_stiffness(const SlidingPart& part_V) {
  return {kDefaultStiffness_N_per_m, kDefaultStiffness_N_per_m * part_V.radius() * part_V.radius()};
}

double default_margin(const SlidingPart& part_V) {
  return std::clamp(1e-4 * part_V.radius(), 2e-6, 10e-6);
}

std::vector<std::shared_ptr<const SlidingPart>> bodies_of(const std::vector<HeldPart>& parts) {
  std::vector<std::shared_ptr<const SlidingPart>> bodies;
  for (const HeldPart& part : parts)
    bodies.push_back(part.part_V);
  return bodies;
}

std::vector<double> margins_of(const std::vector<HeldPart>& parts, const SlidingRules& rules) {
  std::vector<double> margins;
  for (const HeldPart& part : parts)
    margins.push_back(rules.margin.value_or(default_margin(*part.part_V)));
  return margins;
}

void check(const std::vector<HeldPart>& parts, const SlidingRules& rules) {
  if (parts.empty() || parts.size() > kMaxParts) {
    throw std::invalid_argument(std::to_string(parts.size()) + " parts cannot be held at once; 1 to " +
                                std::to_string(kMaxParts) + " can");
  }
  const auto is_stiffness = [](double k) { return k > 0.0 && std::isfinite(k); };
  for (const HeldPart& part : parts) {
    if (part.stiffness && !(is_stiffness(part.stiffness->translational) && is_stiffness(part.stiffness->rotational))) {
      throw std::invalid_argument("the stiffness with which " + part.name + " is held is not a positive number");
    }
  }
  const Friction& friction = rules.friction;
  if (!(friction.sliding >= 0.0 && friction.at_rest >= friction.sliding && std::isfinite(friction.at_rest))) {
    throw std::invalid_argument("the coefficients of friction must be numbers, 0 <= sliding <= at rest, not " +
                                std::to_string(friction.sliding) + " and " + std::to_string(friction.at_rest));
  }
}

/// The largest fraction of a displacement `d` of the part that lets its lag, which was `then` and is `now`, change by
/// no more than `most` metres, or than it has changed already.
double fraction_with_lag(const Displacement& then, const Displacement& now, const Displacement& d, double radius,
                         double most) {
  // Rotations by their angle apart: their vectors may change faster than what they stand for turns.
  const Eigen::Quaterniond q_then = rotation_by(then.w);
  const Eigen::Quaterniond q_now = rotation_by(now.w);
  const auto changed = [&](double fraction) {
    const Eigen::Quaterniond q = q_now * rotation_by(fraction * d.w).conjugate();
    return (now.v - fraction * d.v - then.v).norm() + radius * q.angularDistance(q_then);
  };
  most = std::max(most, changed(0.0));
  if (changed(1.0) <= most) return 1.0;
  double allowed = 0.0;  // the change is convex in the fraction
  double refused = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (allowed + refused);
    (changed(middle) <= most ? allowed : refused) = middle;
  }
  return allowed;
}

/// The same contact as the other part sees it.
Contact mirrored(const Contact& contact, std::int32_t body_of_part, std::int32_t other_part) {
  Contact mirror = contact;
  switch (contact.kind) {
    case ContactKind::kVertexFace:
      mirror.kind = ContactKind::kFaceVertex;
      break;
    case ContactKind::kFaceVertex:
      mirror.kind = ContactKind::kVertexFace;
      break;
    case ContactKind::kVertexEdge:
      mirror.kind = ContactKind::kEdgeVertex;
      break;
    case ContactKind::kEdgeVertex:
      mirror.kind = ContactKind::kVertexEdge;
      break;
    case ContactKind::kEdgeEdge:
    case ContactKind::kVertexVertex:
    case ContactKind::kOverlap:
      break;
  }
  std::swap(mirror.part_triangle, mirror.obstacle_triangle);
  std::swap(mirror.part_feature, mirror.obstacle_feature);
  mirror.part = other_part;
  mirror.obstacle = body_of_part;
  mirror.n_W = -contact.n_W;
  mirror.p_W = contact.q_W();
  mirror.friction_W = -contact.friction_W;
  return mirror;
}

}  // namespace

JointSliding::JointSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                           const SlidingRules& rules)
    : rules_((check(parts, rules), rules)),
      surroundings_(std::move(obstacles), bodies_of(parts), margins_of(parts, rules),
                    kLargestReach_m + kMostLookAhead_m),
      candidates_(surroundings_),
      certificate_(surroundings_),
      overlaps_(surroundings_),
      grips_(parts.size()),
      reach_limit_(kLargestReach_m) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const HeldPart& held = parts[p];
    const std::optional<Eigen::Isometry3d> X_WV = collision::rigid_pose(held.X_WV_start);
    if (!X_WV) throw std::invalid_argument("the start pose of " + held.name + " is not a rotation and translation");
    surroundings_.place(p, *X_WV);
    Part& part = parts_.emplace_back(Part{.part_V = held.part_V,
                                          .metaphor = held.metaphor,
                                          .stiffness = held.stiffness.value_or(default_stiffness(*held.part_V)),
                                          .margin = rules.margin.value_or(default_margin(*held.part_V)),
                                          .anti_jam = AntiJam(held.part_V->radius())});
    part.result.X_WG = *X_WV;
    part.result.X_WT = *X_WV;
    part.result.X_WV = *X_WV;
    part.result.X_WV_of_contacts = *X_WV;
    largest_margin_ = std::max(largest_margin_, part.margin);
  }
  for (const Obstacle& obstacle : surroundings_.obstacles())
    largest_margin_ = std::max(largest_margin_, obstacle.margin.value_or(0.0));
  find_overlaps(parts);
}

/// What overlaps at the start is refused or will be led out, as the rules say.
void JointSliding::find_overlaps(const std::vector<HeldPart>& parts) {
  candidates_.refresh(0.0, {});
  const std::span<const Obstacle> obstacles = surroundings_.obstacles();
  std::vector<BodyPair> found;
  for (const CandidatePair& pair : candidates_.within(0.0)) {
    const BodyPair bodies{pair.obstacle, pair.part};
    if (std::find(found.begin(), found.end(), bodies) != found.end()) continue;
    found.push_back(bodies);
    const auto number = static_cast<std::size_t>(pair.obstacle);
    const bool is_obstacle = number < obstacles.size();
    if (is_obstacle && rules_.overlap == OverlapRule::kLeadOut) {
      overlaps_.add(bodies);
      continue;
    }
    const std::string& name = is_obstacle ? obstacles[number].name : parts[number - obstacles.size()].name;
    throw std::invalid_argument(parts[static_cast<std::size_t>(pair.part) - obstacles.size()].name + " collides with " +
                                name + " at its start pose");
  }
  candidates_.refresh(kFloorOfMargin * largest_margin_, overlaps_.pairs());
  for (const CandidatePair& pair : candidates_.within(kFloorOfMargin * largest_margin_)) {
    if (pair.distance >= surroundings_.floor(pair.obstacle, pair.part)) continue;
    surroundings_.start_near(pair.obstacle, pair.part, pair.distance);
    const BodyPair bodies{pair.obstacle, pair.part};
    if (std::find(near_starts_.begin(), near_starts_.end(), bodies) == near_starts_.end())
      near_starts_.push_back(bodies);
  }
  candidates_.clear();
}

/// Bodies that started nearer to each other than their floor get it back as they come apart. Needs fresh candidates.
void JointSliding::raise_floors() {
  std::erase_if(near_starts_, [&](const BodyPair& bodies) {
    double nearest = kUnbounded;
    for (const CandidatePair& pair : candidates_.within(kFloorOfMargin * largest_margin_)) {
      if (BodyPair{pair.obstacle, pair.part} == bodies) nearest = std::min(nearest, pair.distance);
    }
    if (0.95 * nearest > surroundings_.floor(bodies.obstacle, bodies.part)) {
      surroundings_.start_near(bodies.obstacle, bodies.part, nearest);
    }
    return nearest == kUnbounded;
  });
}

void JointSliding::grasp(std::size_t part, const Eigen::Isometry3d& X_WG) {
  const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG);
  if (!rigid) return;
  Part& held = parts_[part];
  held.result.X_WG = *rigid;
  let_rest(held, SlidingState::kFree);
  held.lag_then = displacement_between(held.result.X_WV, *rigid, held.part_V->p_Vref());
}

void JointSliding::release(std::size_t part) {
  parts_[part].result.X_WG = parts_[part].result.X_WV;
  let_rest(parts_[part], SlidingState::kReleased);
}

/// Nothing is wanted of the part, so nothing pushes it.
void JointSliding::let_rest(Part& part, SlidingState state) {
  part.result.X_WT = part.result.X_WV;
  part.lag_then = {};
  part.result.state = state;
  part.result.contacts.clear();
  part.result.pushing = 0;
  part.result.cycles = 0;
}

void JointSliding::advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  if (!take_ghosts(X_WG, milliseconds)) return;
  if (!overlaps_.empty()) {
    lead_out_ = kSlew_m * milliseconds;
    if (overlaps_.update()) candidates_.clear();
  }
  int cycles = 1;
  for (;; ++cycles) {
    const Step step = cycle();
    aim();
    const bool all_arrived = std::all_of(step.arrives.begin(), step.arrives.begin() + std::ssize(parts_),
                                         [](bool arrives) { return arrives; });
    if (all_arrived || step.length < kNotWorthIt * largest_margin_ || cycles == rules_.max_cycles) break;
  }
  hand_out_contacts();
  was_moving_ = false;
  for (Part& part : parts_) {
    if (!is_held(part)) continue;
    part.result.cycles = cycles;
    part.result.reach = reach_;
    part.result.state = classify(part);
    part.lag_then = lag_of(part);
    was_moving_ = was_moving_ || part.moved > kNotWorthIt * part.margin;
    if (!rules_.anti_jam) continue;
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
    part.X_WG_then = part.result.X_WG;
    const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG[p]);
    if (!is_held(part) || !rigid) continue;
    any = true;
    part.result.X_WG = *rigid;
    part.ghost_motion =
        motion_bound(displacement_between(part.X_WG_then, *rigid, part.part_V->p_Vref()), part.part_V->radius());
    part.result.X_WT = wanted_pose(part.metaphor, part.result.X_WV, part.X_WG_then, *rigid, part.part_V->p_Vref());
    part.X_WA = rules_.anti_jam ? part.anti_jam.aim(part.result.X_WT, part.part_V->p_Vref()) : part.result.X_WT;
  }
  // A part may be pushed by another as fast as the ghost of that one goes.
  const double ghosts = std::accumulate(parts_.begin(), parts_.end(), 0.0,
                                        [](double sum, const Part& part) { return sum + part.ghost_motion; });
  for (Part& part : parts_) {
    part.slew = part.metaphor == Metaphor::kForceFeedback ? kSlew_m * milliseconds + ghosts : kUnbounded;
  }
  return any;
}

/// The rubber band wants what turns with the part.
void JointSliding::aim() {
  for (Part& part : parts_) {
    if (!is_held(part) || part.metaphor != Metaphor::kRubberBand) continue;
    const Eigen::Vector3d& p_Vref = part.part_V->p_Vref();
    part.result.X_WT = wanted_pose(part.metaphor, part.result.X_WV, part.X_WG_then, part.result.X_WG, p_Vref);
    part.X_WA = rules_.anti_jam ? part.anti_jam.aim(part.result.X_WT, p_Vref) : part.result.X_WT;
  }
}

/// One cycle: look around, project, prove, move.
JointSliding::Step JointSliding::cycle() {
  reach_ = choose_reach();
  if (!candidates_.covers(reach_)) refresh_candidates();
  find_rows();

  Displacements wanted;
  double stiffest = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    grips_[p] = is_held(part) ? part.stiffness : kImmovable;
    if (!is_held(part)) continue;
    wanted[p] = displacement_between(part.result.X_WV, part.X_WA, part.part_V->p_Vref());
    stiffest = std::max(stiffest, part.stiffness.translational);
  }
  const double energy_before = energy(wanted);
  // Contacts that ask for their margin back may cost energy; a step that gains any beyond that went over a bend of the
  // contact that the projection did not see, and is tried again with damping.
  const double asked = largest_margin_ + lead_out_;
  const double allowance = 2.0 * asked * std::sqrt(2.0 * energy_before * stiffest) + stiffest * asked * asked;
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
    if (all_arrive || energy(remaining) <= energy_before + allowance) {
      damping_ = damping_ < 0.1 ? 0.0 : 0.25 * damping_;
      lead_out_ = 0.0;
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

/// A query looks some ticks ahead. Where finely cut surfaces lie flush there are very many pairs, and a part that falls
/// behind would look further with every query and so fall behind more; the limit on the reach ends that.
void JointSliding::refresh_candidates() {
  double ghosts = 0.0;
  for (const Part& part : parts_)
    ghosts += part.ghost_motion;
  candidates_.refresh(reach_ + std::clamp(4.0 * ghosts, 30e-6, kMostLookAhead_m), overlaps_.pairs());
  raise_floors();
  const bool too_many = candidates_.size() > kAffordablePairs;
  reach_limit_ = std::clamp((too_many ? 0.5 : 1.25) * reach_limit_, kSmallestReachLimit_m, kLargestReach_m);
}

double JointSliding::choose_reach() const {
  double ghosts = 0.0;
  double slew = 0.0;
  for (const Part& part : parts_) {
    ghosts += part.ghost_motion;
    slew = std::max(slew, part.slew);
  }
  double reach = 1.5 * std::max(ghosts, last_step_) + 2.0 * largest_margin_;
  if (last_clipped_) reach *= 2.0;
  reach = std::max(reach, lead_out_ + 2.0 * largest_margin_);
  return std::clamp(std::min(reach, slew + ghosts + 2.0 * largest_margin_), kSmallestReach_m, reach_limit_);
}

void JointSliding::find_rows() {
  find_contacts(surroundings_.bodies(), surroundings_.obstacles().size(), candidates_.within(reach_), reach_,
                largest_margin_, contacts_);
  for (const WayOut& way : overlaps_.ways_out()) {
    Contact& contact = contacts_.emplace_back();
    contact.kind = ContactKind::kOverlap;
    contact.part = way.bodies.part - static_cast<std::int32_t>(surroundings_.obstacles().size());
    contact.obstacle = way.bodies.obstacle;
    contact.n_W = way.n_W;
    contact.p_W = reference_point(static_cast<std::size_t>(contact.part));
    contact.gap = -way.depth;
  }
  for (Part& part : parts_)
    part.result.X_WV_of_contacts = part.result.X_WV;
  rows_.clear();
  for (const Contact& contact : contacts_) {
    double bound = 0.0;
    if (contact.kind == ContactKind::kOverlap) {
      bound = std::min(lead_out_, -contact.gap);
    } else {
      // A contact nearer than the margin asks for some of it back.
      const auto body = static_cast<std::int32_t>(surroundings_.body_of_part(static_cast<std::size_t>(contact.part)));
      const double missing = surroundings_.margin(contact.obstacle, body) - contact.gap;
      bound = missing > 0.0 ? 0.7 * missing : missing;
    }
    add_row(contact.obstacle, static_cast<std::size_t>(contact.part), contact.n_W, contact.p_W, bound);
  }
}

Displacement JointSliding::lag_of(const Part& part) const {
  return displacement_between(part.result.X_WV, part.result.X_WT, part.part_V->p_Vref());
}

Eigen::Vector3d JointSliding::reference_point(std::size_t part) const {
  return parts_[part].result.X_WV * parts_[part].part_V->p_Vref();
}

void JointSliding::add_row(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W,
                           const Eigen::Vector3d& p_W, double bound) {
  JointRow& row = rows_.emplace_back();
  row.n = n_W;
  row.r = p_W - reference_point(part);
  row.bound = bound;
  row.part = static_cast<std::int32_t>(part);
  const auto obstacles = static_cast<std::int32_t>(surroundings_.obstacles().size());
  bool is_held_by_any = is_held(parts_[part]);
  if (obstacle >= obstacles) {
    row.other = obstacle - obstacles;
    const auto other = static_cast<std::size_t>(row.other);
    row.r_other = p_W - reference_point(other);
    is_held_by_any = is_held_by_any || is_held(parts_[other]);
  }
  // What nobody holds gives no margin back.
  if (!is_held_by_any) row.bound = -kUnbounded;
}

/// The largest step towards `wanted` that can be proved free.
JointSliding::Step JointSliding::certified_step(std::span<const Displacement> wanted) {
  rows_.resize(contacts_.size());
  proof_contacts_.clear();
  Step step;
  Step first;  // what the contacts alone allow
  bool proved = false;
  int projections = 0;
  for (; projections < kProjections && !proved; ++projections) {
    if (projections > 0) add_rows_for_failures();
    if (!project_on_rows(wanted)) return {.clipped = true};
    const std::array<double, kMaxParts> fractions = allowed_fractions(projected_);
    Displacements shortened;
    step.clipped = false;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      shortened[p] = projected_[p].scaled(fractions[p]);
      step.arrives[p] = fractions[p] == 1.0;
      step.clipped = step.clipped || fractions[p] < 1.0;
    }
    proved = prove(shortened, step);
    if (projections > 0) continue;
    first = step;
    first_forces_ = forces_;
  }
  // Rows for failed proofs forbid more than they must, and may leave nothing where a shorter step would be free.
  if (proved && projections > 1 && step.length < kNotWorthIt * largest_margin_) {
    proved = false;
    step = first;
    forces_ = first_forces_;
  }
  for (int halving = 0; halving < kHalvings && !proved; ++halving) {
    Displacements half;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      half[p] = step.displacements[p].scaled(0.5);
    proved = prove(half, step);
    step.arrives.fill(false);
    step.clipped = true;
  }
  if (!proved) return {.clipped = true};
  for (const RowForce& force : forces_) {
    const JointRow& row = rows_[static_cast<std::size_t>(force.row)];
    step.arrives[static_cast<std::size_t>(row.part)] = false;
    if (row.other >= 0) step.arrives[static_cast<std::size_t>(row.other)] = false;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p)
    step.arrives[p] = step.arrives[p] || !is_held(parts_[p]);
  return step;
}

/// Makes `step` those displacements and tells whether they are proved free.
bool JointSliding::prove(const Displacements& displacements, Step& step) {
  step.displacements = displacements;
  step.length = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    step.lengths[p] = motion_bound(displacements[p], parts_[p].part_V->radius());
    step.length += step.lengths[p];
  }
  // Pairs further away than this keep the floor whatever happens on the way.
  const double concerned = step.length + kFloorOfMargin * largest_margin_;
  return candidates_.covers(concerned) &&
         certificate_.prove({displacements.data(), parts_.size()}, candidates_.within(concerned), failures_);
}

/// Projects on all rows; false when the solver finds nothing, which leaves standing still.
bool JointSliding::project_on_rows(std::span<const Displacement> wanted) {
  JointProjection projection = solver_.project(wanted, grips_, rows_);
  if (projection.status == ProjectionStatus::kInfeasible) {
    // Not every contact can have its margin back. Standing still is always allowed.
    for (JointRow& row : rows_)
      row.bound = std::min(row.bound, 0.0);
    projection = solver_.project(wanted, grips_, rows_);
  }
  forces_.clear();
  projected_.fill({});
  if (projection.status != ProjectionStatus::kSolved) return false;
  if (rules_.friction.is_on() && projection.active_count > 0) {
    remember_forces();
    if (!forces_.empty()) {
      solve_friction(wanted);
      return true;
    }
  }
  projected_ = projection.displacements;
  for (int i = 0; i < projection.active_count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    forces_.push_back({projection.active[slot], projection.force[slot]});
  }
  if (rules_.friction.is_on() && projection.active_count > 0) solve_friction(wanted);
  return true;
}

void JointSliding::solve_friction(std::span<const Displacement> wanted) {
  const double coefficient = was_moving_ ? rules_.friction.sliding : rules_.friction.at_rest;
  friction_solver_.solve(wanted, grips_, rows_, coefficient, projected_, forces_);
}

/// Those of the last cycle, where the same features still touch.
void JointSliding::remember_forces() {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    for (const Contact& before : pushed_) {
      if (before.part != contact.part || before.obstacle != contact.obstacle || before.kind != contact.kind ||
          before.part_feature != contact.part_feature || before.obstacle_feature != contact.obstacle_feature) {
        continue;
      }
      forces_.push_back({static_cast<std::int32_t>(i), before.force, before.friction_W});
      break;
    }
  }
}

/// How much of its displacement each part may go: by the reach, the slew and the linearisation of rotations. Parts that
/// touch, or may soon, are shortened alike, or what holds for both together would not hold any more.
std::array<double, kMaxParts> JointSliding::allowed_fractions(const Displacements& d) const {
  std::array<double, kMaxParts> fractions{};
  const double share = (reach_ - largest_margin_) / static_cast<double>(parts_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    const double radius = part.part_V->radius();
    fractions[p] = fraction_within(d[p], radius, share);
    if (part.slew != kUnbounded && is_held(part)) {
      const double by_lag = fraction_with_lag(part.lag_then, lag_of(part), d[p], radius, part.slew);
      fractions[p] = std::min(fractions[p], by_lag);
    }
    const double angle = d[p].w.norm();
    const double largest_angle = std::sqrt(part.margin / radius);
    if (!rows_.empty() && angle * fractions[p] > largest_angle) fractions[p] = largest_angle / angle;
  }
  for (std::size_t pass = 1; pass < parts_.size(); ++pass) {
    for (const JointRow& row : rows_) {
      if (row.other < 0) continue;
      double& a = fractions[static_cast<std::size_t>(row.part)];
      double& b = fractions[static_cast<std::size_t>(row.other)];
      a = b = std::min(a, b);
    }
  }
  return fractions;
}

/// Keeps each triangle of the part that could not be proved apart on its side of the plane that separated it.
void JointSliding::add_rows_for_failures() {
  for (const UncertifiedPair& failure : failures_) {
    const PlacedBody& obstacle = surroundings_.bodies()[static_cast<std::size_t>(failure.obstacle)];
    const PlacedBody& part = surroundings_.bodies()[static_cast<std::size_t>(failure.part)];
    const std::size_t number = static_cast<std::size_t>(failure.part) - surroundings_.obstacles().size();
    const double margin = surroundings_.margin(failure.obstacle, failure.part);
    double top = -kUnbounded;
    for (const Eigen::Vector3d& y_W : obstacle.triangle_W(failure.obstacle_triangle))
      top = std::max(top, failure.n_W.dot(y_W));
    for (const Eigen::Vector3d& x_W : part.triangle_W(failure.part_triangle)) {
      const double gap = failure.n_W.dot(x_W) - top;
      add_row(failure.obstacle, number, failure.n_W, x_W, std::min(0.0, margin - gap));
      Contact& contact =
          proof_contacts_.emplace_back(Contact{ContactKind::kVertexFace, failure.part_triangle, failure.obstacle,
                                               failure.obstacle_triangle, failure.n_W, x_W, gap});
      contact.part = static_cast<std::int32_t>(number);
    }
  }
}

double JointSliding::energy(std::span<const Displacement> errors) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const CouplingStiffness& k = parts_[p].stiffness;
    sum += 0.5 * (k.translational * errors[p].v.squaredNorm() + k.rotational * errors[p].w.squaredNorm());
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
  candidates_.moved(step.length);
  last_step_ = step.length;
  last_clipped_ = step.clipped;
}

/// To each part its own, as it sees them.
void JointSliding::hand_out_contacts() {
  const auto obstacles = static_cast<std::int32_t>(surroundings_.obstacles().size());
  if (parts_.size() == 1) {
    std::swap(parts_.front().result.contacts, contacts_);
  } else {
    for (Part& part : parts_)
      part.result.contacts.clear();
    for (const Contact& contact : contacts_) {
      const auto number = static_cast<std::size_t>(contact.part);
      parts_[number].result.contacts.push_back(contact);
      if (contact.obstacle < obstacles) continue;
      const std::int32_t other = contact.obstacle - obstacles;
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
