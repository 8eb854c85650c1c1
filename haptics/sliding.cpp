#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glissade/collision/rigid_pose.h>
#include <glissade/haptics/contact_search.h>
#include <glissade/haptics/sliding.h>

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

CouplingStiffness default_stiffness(const SlidingPart& part_V) {
  return {kDefaultStiffness_N_per_m, kDefaultStiffness_N_per_m * part_V.radius() * part_V.radius()};
}

}  // namespace

Sliding::Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
                 const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options)
    : part_V_(std::move(part_V)),
      surroundings_(std::move(obstacles), part_V_, kLargestReach_m + kMostLookAhead_m),
      stiffness_(options.stiffness.value_or(default_stiffness(*part_V_))),
      metaphor_(options.metaphor),
      max_cycles_(options.max_cycles),
      margin_(std::clamp(1e-4 * part_V_->radius(), 2e-6, 10e-6)),
      candidates_(surroundings_, *part_V_),
      certificate_(surroundings_.obstacles(), *part_V_, kFloorOfMargin * margin_),
      reach_limit_(kLargestReach_m) {
  const std::optional<Eigen::Isometry3d> X_WV = collision::rigid_pose(X_WV_start);
  if (!X_WV) throw std::invalid_argument("the start pose of the part is not a rotation and translation");
  const collision::FrameResult& start = surroundings_.look_around(*X_WV, 0.0);
  if (!start.meeting.empty()) {
    const std::string& name = surroundings_.obstacles()[start.meeting.front().object_A.index].name;
    throw std::invalid_argument("the part collides with " + name + " at its start pose");
  }
  result_.X_WG = *X_WV;
  result_.X_WT = *X_WV;
  result_.X_WV = *X_WV;
}

const Sliding::Step Sliding::kNoStep{{}, 0.0, false, true};

void Sliding::grasp(const Eigen::Isometry3d& X_WG) {
  const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG);
  if (!rigid) return;
  result_.X_WG = *rigid;
  let_rest(SlidingState::kFree);
}

void Sliding::release() {
  result_.X_WG = result_.X_WV;
  let_rest(SlidingState::kReleased);
}

/// Nothing is wanted of the part, so nothing pushes it.
void Sliding::let_rest(SlidingState state) {
  result_.X_WT = result_.X_WV;
  result_.state = state;
  result_.contacts.clear();
  result_.pushing = 0;
  result_.cycles = 0;
}

const SlidingResult& Sliding::advance(const Eigen::Isometry3d& X_WG_given, double milliseconds) {
  const std::optional<Eigen::Isometry3d> rigid = collision::rigid_pose(X_WG_given);
  if (!rigid || result_.state == SlidingState::kReleased) return result_;
  const Eigen::Isometry3d X_WG_then = result_.X_WG;
  result_.X_WG = *rigid;
  ghost_motion_ = motion_bound(displacement_between(X_WG_then, *rigid, part_V_->p_Vref()), part_V_->radius());
  result_.X_WT = wanted_pose(metaphor_, result_.X_WV, X_WG_then, *rigid, part_V_->p_Vref());
  double budget = metaphor_ == Metaphor::kForceFeedback ? kSlew_m * milliseconds + 2.0 * ghost_motion_
                                                        : std::numeric_limits<double>::infinity();
  double moved = 0.0;
  for (result_.cycles = 1;; ++result_.cycles) {
    const Step step = cycle(budget);
    budget -= step.length;
    moved += step.length;
    // The rubber band wants what turns with the part.
    if (metaphor_ == Metaphor::kRubberBand) {
      result_.X_WT = wanted_pose(metaphor_, result_.X_WV, X_WG_then, *rigid, part_V_->p_Vref());
    }
    if (step.arrives || step.length < 0.05 * margin_ || result_.cycles == max_cycles_) break;
  }
  result_.state = classify(moved);
  return result_;
}

/// One cycle: look around, project, prove, move.
Sliding::Step Sliding::cycle(double budget) {
  result_.reach = choose_reach(budget);
  if (!candidates_.covers(result_.reach)) refresh_candidates();
  find_rows();

  const Displacement wanted = error();
  const double energy_before = energy(wanted);
  // Contacts that ask for their margin back may cost energy; a step that gains any beyond that went over a bend of the
  // contact that the projection did not see, and is tried again with damping.
  const double allowance = 2.0 * margin_ * std::sqrt(2.0 * energy_before * stiffness_.translational) +
                           stiffness_.translational * margin_ * margin_;
  Step step;
  for (int trial = 0; trial < kDampings; ++trial) {
    step = certified_step(wanted.scaled(1.0 / (1.0 + damping_)), budget);
    step.arrives = step.arrives && damping_ == 0.0;
    const Displacement remaining = displacement_between(displaced(result_.X_WV, part_V_->p_Vref(), step.displacement),
                                                        result_.X_WT, part_V_->p_Vref());
    if (step.arrives || energy(remaining) <= energy_before + allowance) {
      damping_ = damping_ < 0.1 ? 0.0 : 0.25 * damping_;
      apply(step);
      return step;
    }
    damping_ = std::clamp(4.0 * damping_, 0.5, kLargestDamping);
  }
  damping_ = 0.0;
  apply(kNoStep);
  return kNoStep;
}

/// A query looks some ticks ahead. Where finely cut surfaces lie flush there are very many pairs, and a part that falls
/// behind would look further with every query and so fall behind more; the limit on the reach ends that.
void Sliding::refresh_candidates() {
  candidates_.refresh(result_.X_WV, result_.reach + std::clamp(4.0 * ghost_motion_, 30e-6, kMostLookAhead_m));
  const bool too_many = candidates_.size() > kAffordablePairs;
  reach_limit_ = std::clamp((too_many ? 0.5 : 1.25) * reach_limit_, kSmallestReachLimit_m, kLargestReach_m);
}

double Sliding::choose_reach(double budget) const {
  double reach = 1.5 * std::max(ghost_motion_, last_step_) + 2.0 * margin_;
  if (last_clipped_) reach *= 2.0;
  return std::clamp(std::min(reach, budget + 2.0 * margin_), kSmallestReach_m, reach_limit_);
}

void Sliding::find_rows() {
  find_contacts(surroundings_.obstacles(), *part_V_, result_.X_WV, candidates_.within(result_.reach), result_.reach,
                margin_, result_.contacts);
  result_.X_WV_of_contacts = result_.X_WV;
  const Eigen::Vector3d p_Wref = result_.X_WV * part_V_->p_Vref();
  rows_.clear();
  for (const Contact& contact : result_.contacts) {
    // A contact nearer than the margin asks for some of it back.
    const double missing = margin_ - contact.gap;
    const double bound = missing > 0.0 ? 0.7 * missing : missing;
    rows_.push_back({contact.n_W, contact.p_W - p_Wref, bound});
  }
}

/// The largest step towards `wanted` that can be proved free.
Sliding::Step Sliding::certified_step(const Displacement& wanted, double budget) {
  rows_.resize(result_.contacts.size());
  proof_contacts_.clear();
  Step step;
  bool proved = false;
  for (int projection = 0; projection < kProjections && !proved; ++projection) {
    if (projection > 0) add_rows_for_failures();
    if (!project_on_rows(wanted)) return kNoStep;
    const double fraction = allowed_fraction(projection_.displacement, budget);
    proved = prove(projection_.displacement.scaled(fraction), step);
    step.clipped = fraction < 1.0;
  }
  for (int halving = 0; halving < kHalvings && !proved; ++halving) {
    proved = prove(step.displacement.scaled(0.5), step);
    step.clipped = true;
  }
  if (!proved) return kNoStep;
  step.arrives = !step.clipped && projection_.active_count == 0;
  return step;
}

/// Makes `step` that displacement and tells whether it is proved free.
bool Sliding::prove(const Displacement& displacement, Step& step) {
  step.displacement = displacement;
  step.length = motion_bound(displacement, part_V_->radius());
  // Pairs further away than this keep the floor whatever happens on the way.
  const double concerned = step.length + floor();
  return candidates_.covers(concerned) &&
         certificate_.prove(result_.X_WV, displacement, candidates_.within(concerned), failures_);
}

/// Projects on all rows; false when the solver finds nothing, which leaves standing still.
bool Sliding::project_on_rows(const Displacement& wanted) {
  projection_ = project(wanted, stiffness_, rows_);
  if (projection_.status == ProjectionStatus::kInfeasible) {
    // Not every contact can have its margin back. Standing still is always allowed.
    for (ConstraintRow& row : rows_)
      row.bound = std::min(row.bound, 0.0);
    projection_ = project(wanted, stiffness_, rows_);
  }
  if (projection_.status == ProjectionStatus::kSolved) return true;
  projection_ = Projection{};
  return false;
}

/// How much of a displacement the reach, the slew and the linearisation of rotations allow.
double Sliding::allowed_fraction(const Displacement& d, double budget) const {
  double fraction = fraction_within(d, part_V_->radius(), std::min(result_.reach - margin_, budget));
  const double angle = d.w.norm();
  const double largest_angle = std::sqrt(margin_ / part_V_->radius());
  if (!rows_.empty() && angle * fraction > largest_angle) fraction = largest_angle / angle;
  return fraction;
}

/// Keeps each triangle of the part that could not be proved apart on its side of the plane that separated it.
void Sliding::add_rows_for_failures() {
  const auto& part = part_V_->tree.mesh();
  const Eigen::Vector3d p_Wref = result_.X_WV * part_V_->p_Vref();
  for (const UncertifiedPair& failure : failures_) {
    const Obstacle& obstacle = surroundings_.obstacles()[static_cast<std::size_t>(failure.obstacle)];
    double top = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& y_W : obstacle.triangle_W(failure.obstacle_triangle))
      top = std::max(top, failure.n_W.dot(y_W));
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d x_W = result_.X_WV * part.corner(failure.part_triangle, c);
      const double gap = failure.n_W.dot(x_W) - top;
      rows_.push_back({failure.n_W, x_W - p_Wref, std::min(0.0, margin_ - gap)});
      proof_contacts_.push_back({ContactKind::kVertexFace, failure.part_triangle, failure.obstacle,
                                 failure.obstacle_triangle, failure.n_W, x_W, gap});
    }
  }
}

double Sliding::energy(const Displacement& error) const {
  return 0.5 * (stiffness_.translational * error.v.squaredNorm() + stiffness_.rotational * error.w.squaredNorm());
}

void Sliding::apply(const Step& step) {
  const std::size_t found = result_.contacts.size();
  for (int i = 0; i < projection_.active_count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const auto row = static_cast<std::size_t>(projection_.active[slot]);
    // A row that only a failed proof asked for holds the part like any contact, and is told like one.
    Contact& contact =
        row < found ? result_.contacts[row] : result_.contacts.emplace_back(proof_contacts_[row - found]);
    contact.force = projection_.force[slot];
  }
  result_.pushing = projection_.active_count;
  // An arrival copies the wanted pose, so that the coupling wrench is zero and not merely small.
  // Standing still keeps every bit.
  if (step.arrives) {
    result_.X_WV = result_.X_WT;
  } else if (step.length > 0.0) {
    result_.X_WV = displaced(result_.X_WV, part_V_->p_Vref(), step.displacement);
  }
  candidates_.moved(step.length);
  last_step_ = step.length;
  last_clipped_ = step.clipped;
}

SlidingState Sliding::classify(double moved) const {
  if (result_.X_WV.matrix() == result_.X_WT.matrix()) return SlidingState::kFree;
  if (result_.pushing == 0) return SlidingState::kCatchingUp;
  return moved > 0.05 * margin_ ? SlidingState::kSliding : SlidingState::kResting;
}

}  // namespace glissade::haptics
