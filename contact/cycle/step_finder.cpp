#include "cycle/step_finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "cycle/allowed_fraction.h"
#include "cycle/energy.h"
#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

constexpr int kDampings = 4;
constexpr double kLargestDamping = 1e3;
constexpr int kProjections = 4;  // the first, and three more with rows for failed certificates
constexpr int kHalvings = 6;

// Work of a projection, in the unit of `collision::WorkMeter`: rough. Steps take 0.4 ns a unit.
constexpr std::int64_t kWorkOfProjection = 500;
constexpr std::int64_t kWorkOfRow = 50;
constexpr std::int64_t kWorkOfFriction = 60;  // of an evaluation of a contact
/// Evaluations of each contact, however little work is left.
constexpr std::int64_t kLeastFriction = 40;

constexpr CouplingStiffness kImmovable{kUnbounded, kUnbounded};

/// Metres: shorter than anything that matters.
constexpr double kNoMotion_m = 1e-18;

/// A displacement without what rounding has left of a translation or rotation. From step to step it would shrink to
/// numbers that are too small to be written and read.
geometry::Displacement without_rounding(const geometry::Displacement& d, double lever) {
  geometry::Displacement cleared = d;
  if (d.v.norm() < kNoMotion_m) cleared.v.setZero();
  if (lever * d.w.norm() < kNoMotion_m) cleared.w.setZero();
  return cleared;
}

}  // namespace

StepFinder::StepFinder(SimulatedParts& shared)
    : shared_(shared), rows_(shared), turned_rows_(shared), certificate_(shared.scene), grips_(shared.count()) {}

void StepFinder::look(double reach, double reach_ahead, WorkBudget& budget) {
  reach_ = reach;
  rows_.find(reach, reach_ahead, budget);
}

std::optional<Step> StepFinder::find(WorkBudget& budget) {
  if (!is_under_way()) begin(budget);
  while (is_under_way()) {
    if (!certificate_.go_on(budget) || budget.is_used_up()) return std::nullopt;
    conclude(is_covered_ && certificate_.failures().empty(), budget);
  }
  return step_;
}

std::array<double, kMaxParts> StepFinder::find_forces(WorkBudget& budget) {
  aim();
  rows_.keep_contacts_only();
  Displacements left;
  do {
    if (!project(wanted_, budget)) return {};
    left = shorten();
  } while (rows_.find_violated(left, budget));
  std::array<double, kMaxParts> lengths{};
  for (std::size_t p = 0; p < shared_.count(); ++p)
    lengths[p] = geometry::motion_bound(left[p], shared_.states[p].lever);
  return lengths;
}

/// Sets the wanted displacements.
void StepFinder::aim() {
  const std::vector<HeldPartState>& parts = shared_.states;
  wanted_ = {};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    grips_[p] = parts[p].is_held() ? parts[p].stiffness : kImmovable;
    if (!parts[p].is_held()) continue;
    wanted_[p] = geometry::displacement_between(parts[p].result.X_WV, parts[p].X_WS, parts[p].p_Vref);
  }
}

void StepFinder::begin(WorkBudget& budget) {
  aim();
  const std::vector<HeldPartState>& parts = shared_.states;
  // A step that gains more energy than this has passed a bend of the contact that the linear rows do not describe. It
  // is repeated with damping. So is a step of a part that finds no rest if it gains any, or the part would go in a
  // circle of steps that give it margin back and steps that take it.
  bool all_stay = true;
  bool is_restless = false;
  for (const HeldPartState& part : parts) {
    if (!part.is_held()) continue;
    all_stay = all_stay && part.rest_watch.stays();
    is_restless = is_restless || part.rest_watch.is_restless();
  }
  most_energy_ = energy(parts, wanted_);
  if (!all_stay || !is_restless) most_energy_ += energy_allowance(parts, wanted_, shared_.largest_margin);
  trial_ = 0;
  begin_trial(budget);
}

void StepFinder::begin_trial(WorkBudget& budget) {
  damped_ = {};
  for (std::size_t p = 0; p < shared_.count(); ++p)
    damped_[p] = wanted_[p].scaled(1.0 / (1.0 + damping_));
  rows_.keep_contacts_only();
  projections_ = 0;
  halvings_ = 0;
  stage_ = Stage::kProjecting;
  try_projection(budget);
}

/// Begins the certificate of the largest step that the rows allow.
void StepFinder::try_projection(WorkBudget& budget) {
  Displacements shortened;
  do {
    is_first_order_ = false;
    if (!project(damped_, budget)) {
      step_ = {.clipped = true};
      end_trial(budget);
      return;
    }
    shortened = shorten();
    if (is_worth_another(shortened)) {
      budget.spend(kWorkOfProjection + kWorkOfRow * std::ssize(rows_.rows()));
      is_first_order_ = !project_again();
      shortened = shorten();
    }
  } while (rows_.find_violated(shortened, budget));
  ++projections_;
  begin_certificate(shortened, budget);
}

/// The projected displacements, as far as they may lead. Begins the step with what is known of it then.
Displacements StepFinder::shorten() {
  Displacements shortened;
  const AllowedFractions allowed = allowed_fractions(shared_, projected_, rows_, reach_);
  step_ = {};
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    const double fraction = allowed.of_parts[p];
    shortened[p] = projected_[p].scaled(fraction);
    step_.missed[p] = projected_[p].scaled(allowed.beyond_reach[p] - fraction);
    step_.arrives[p] = fraction == 1.0;
    step_.clipped = step_.clipped || fraction < 1.0;
    step_.is_reach_short = step_.is_reach_short || fraction < allowed.beyond_reach[p];
  }
  keep_covered(shortened);
  return shortened;
}

/// Whether the projected displacements turn the contacts so far that another projection would change them by as much as
/// a step that counts: the forces turn with the contacts, and gaps change to second order.
bool StepFinder::is_worth_another(const Displacements& displacements) const {
  if (step_.clipped || damping_ > 0.0 || forces_.empty() || shared_.rules.friction.is_on()) return false;
  double change = 0.0;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    const geometry::Displacement& d = displacements[p];
    const double lever = shared_.states[p].lever;
    const geometry::Displacement left{wanted_[p].v - d.v, wanted_[p].w - d.w};
    change += d.w.norm() * (geometry::motion_bound(left, lever) + geometry::motion_bound(d, lever));
  }
  return change > kNotWorthIt * shared_.largest_margin;
}

/// Projects what is left after the projected displacements on the rows as they are there, and adds it to them. Returns
/// false if the solver finds no solution; then nothing changes.
bool StepFinder::project_again() {
  const std::vector<HeldPartState>& parts = shared_.states;
  Displacements left;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (projected_[p].is_zero()) left[p] = wanted_[p];  // to the bit: a part that stands is not to move by a rounding
    if (!parts[p].is_held() || projected_[p].is_zero()) continue;
    const Eigen::Vector3d& p_Vref = parts[p].p_Vref;
    left[p] = geometry::displacement_between(geometry::displaced(parts[p].result.X_WV, p_Vref, projected_[p]),
                                             parts[p].X_WS, p_Vref);
  }
  const CoupledProjection projection =
      solver_.project(shared_.of_parts(left), grips_, turned_rows_.find(projected_, rows_.rows(), rows_.contacts()));
  if (projection.status != ProjectionStatus::kSolved) return false;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (projection.displacements[p].is_zero()) continue;
    const Eigen::Isometry3d& X_WV = parts[p].result.X_WV;
    const Eigen::Vector3d& p_Vref = parts[p].p_Vref;
    const Eigen::Isometry3d X_WV_to =
        geometry::displaced(geometry::displaced(X_WV, p_Vref, projected_[p]), p_Vref, projection.displacements[p]);
    projected_[p] = geometry::displacement_between(X_WV, X_WV_to, p_Vref);
  }
  set_forces(projection);
  return true;
}

void StepFinder::set_forces(const CoupledProjection& projection) {
  forces_.clear();
  for (int i = 0; i < projection.active_count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    forces_.push_back({projection.active[slot], projection.force[slot]});
  }
}

/// Shortens a step whose path the candidates do not cover. They cover every path that is no longer than their distance
/// around its beginning. All parts take the same share, because their rows hold for all displacements together.
void StepFinder::keep_covered(Displacements& displacements) {
  const double needed = shared_.largest_margin + certificate_.certain_distance();
  certificate_.begin_step(shared_.of_parts(displacements));
  if (shared_.candidates.covered_on_path(certificate_) >= needed) return;
  const double most = std::max(0.0, shared_.candidates.covered() - needed) / static_cast<double>(shared_.count());
  double fraction = 1.0;
  for (std::size_t p = 0; p < shared_.count(); ++p)
    fraction = std::min(fraction, geometry::fraction_within(displacements[p], shared_.states[p].lever, most));
  if (fraction == 1.0) return;
  step_.clipped = true;
  step_.is_uncovered = true;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    const geometry::Displacement whole = displacements[p];
    displacements[p] = whole.scaled(fraction);
    step_.missed[p].v += whole.v - displacements[p].v;
    step_.missed[p].w += whole.w - displacements[p].w;
    step_.arrives[p] = false;
  }
}

/// Takes the step at hand, or begins the certificate of another one.
void StepFinder::conclude(bool is_certified, WorkBudget& budget) {
  shared_.candidates.pairs().note_planes(certificate_.separated());
  if (stage_ == Stage::kProjecting) {
    if (projections_ == 1) {
      first_ = step_;
      first_forces_ = forces_;
    }
    if (!is_certified && projections_ < kProjections) {
      rows_.add_failures(certificate_.failures());
      try_projection(budget);
      return;
    }
    // Rows of failed certificates forbid more than necessary. They may leave nothing where a shorter step would be
    // free.
    if (projections_ > 1 && step_.length < kNotWorthIt * shared_.largest_margin) {
      is_certified = false;
      step_ = first_;
      forces_ = first_forces_;
    }
  }
  if (is_certified) {
    note_arrivals();
    end_trial(budget);
  } else if (halvings_ < kHalvings + static_cast<int>(shared_.count())) {
    try_half(budget);
  } else {
    step_ = {.clipped = true};
    end_trial(budget);
  }
}

/// Shortens the parts whose pairs fail; the others go on.
void StepFinder::try_half(WorkBudget& budget) {
  stage_ = Stage::kHalving;
  const std::array<bool, kMaxParts> fails = parts_that_fail();
  Displacements shortened = step_.displacements;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    if (!fails[p]) continue;
    shortened[p] = shortened[p].scaled(halvings_ < kHalvings ? 0.5 : 0.0);
    step_.arrives[p] = false;
  }
  step_.clipped = true;
  ++halvings_;
  begin_certificate(shortened, budget);
}

/// A part on which a contact pushes, or whose target is damped, does not arrive.
void StepFinder::note_arrivals() {
  for (const RowForce& force : forces_) {
    const CoupledRow& row = rows_.rows()[static_cast<std::size_t>(force.row)];
    step_.arrives[static_cast<std::size_t>(row.part)] = false;
    if (row.other >= 0) step_.arrives[static_cast<std::size_t>(row.other)] = false;
  }
  for (std::size_t p = 0; p < shared_.count(); ++p)
    step_.arrives[p] = (step_.arrives[p] || !shared_.states[p].is_held()) && damping_ == 0.0;
}

/// Takes the step, or begins again with more damping.
void StepFinder::end_trial(WorkBudget& budget) {
  if (!gains_energy()) {
    step_.is_plain = !step_.clipped && damping_ == 0.0 && projections_ == 1 && !is_first_order_;
    damping_ = damping_ < 0.1 ? 0.0 : 0.25 * damping_;
    stage_ = Stage::kDone;
    return;
  }
  damping_ = std::clamp(4.0 * damping_, 0.5, kLargestDamping);
  if (++trial_ < kDampings) {
    begin_trial(budget);
    return;
  }
  damping_ = 0.0;
  step_ = {.clipped = true};
  stage_ = Stage::kDone;
}

/// Whether the springs hold more energy after the step than is allowed.
bool StepFinder::gains_energy() {
  const std::vector<HeldPartState>& parts = shared_.states;
  bool all_arrive = true;
  Displacements remaining;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    all_arrive = all_arrive && step_.arrives[p];
    if (!parts[p].is_held()) continue;
    const Eigen::Vector3d& p_Vref = parts[p].p_Vref;
    remaining[p] = geometry::displacement_between(
        geometry::displaced(parts[p].result.X_WV, p_Vref, step_.displacements[p]), parts[p].X_WS, p_Vref);
  }
  return !all_arrive && energy(parts, remaining) > most_energy_;
}

/// The parts of the pairs that could not be certified; all parts if the candidates did not even cover the step.
std::array<bool, kMaxParts> StepFinder::parts_that_fail() const {
  std::array<bool, kMaxParts> fails{};
  if (certificate_.failures().empty()) fails.fill(true);
  for (const UncertifiedPair& failure : certificate_.failures()) {
    for (const std::int32_t body : {failure.bodies.part, failure.bodies.obstacle}) {
      const std::int32_t part = shared_.scene.leader(body);
      if (part != ContactScene::kStands) fails[static_cast<std::size_t>(part)] = true;
    }
  }
  return fails;
}

/// Sets the displacements of the step, and begins their certificate.
void StepFinder::begin_certificate(const Displacements& displacements, WorkBudget& budget) {
  step_.displacements = {};
  step_.length = 0.0;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    step_.displacements[p] = without_rounding(displacements[p], shared_.states[p].lever);
    step_.lengths[p] = geometry::motion_bound(step_.displacements[p], shared_.states[p].lever);
    step_.length += step_.lengths[p];
  }
  // Bodies farther apart than this keep their minimum clearance whatever happens on the way.
  const double concerned = step_.length + shared_.largest_clearance + certificate_.certain_distance();
  certificate_.begin_step(shared_.of_parts(step_.displacements));
  is_covered_ = shared_.candidates.covers(concerned) ||
                shared_.candidates.covered_on_path(certificate_) >= concerned - step_.length;
  step_.is_uncovered = step_.is_uncovered || !is_covered_;
  to_certify_.clear();
  if (is_covered_) shared_.candidates.pairs().unproved_within(concerned, certificate_, to_certify_, budget);
  certificate_.begin(to_certify_);
}

/// Projects on all rows. Returns false if the solver finds no solution; then the parts stand still.
bool StepFinder::project(const Displacements& wanted, WorkBudget& budget) {
  const std::span<const geometry::Displacement> of_parts = shared_.of_parts(wanted);
  const std::int64_t work = kWorkOfProjection + kWorkOfRow * std::ssize(rows_.rows());
  budget.spend(work);
  CoupledProjection projection = solver_.project(of_parts, grips_, rows_.rows());
  if (is_too_narrow(projection)) {
    rows_.use_room(parts_without_room(wanted));
    budget.spend(2 * work);
    projection = solver_.project(of_parts, grips_, rows_.rows());
  } else {
    rows_.margins_fit();
  }
  forces_.clear();
  projected_.fill({});
  if (projection.status != ProjectionStatus::kSolved) return false;
  projected_ = projection.displacements;
  set_forces(projection);
  if (shared_.rules.friction.is_on() && !forces_.empty()) solve_friction(wanted, budget);
  return true;
}

/// Whether not every contact can have its margin back, or only for more energy of the springs than a margin is worth.
bool StepFinder::is_too_narrow(const CoupledProjection& projection) const {
  if (projection.status == ProjectionStatus::kInfeasible) return true;
  if (projection.status != ProjectionStatus::kSolved) return false;
  Displacements left;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    const geometry::Displacement& d = projection.displacements[p];
    if (shared_.states[p].is_held()) left[p] = {wanted_[p].v - d.v, wanted_[p].w - d.w};
  }
  return energy(shared_.states, left) >
         energy(shared_.states, wanted_) + energy_allowance(shared_.states, wanted_, shared_.largest_margin);
}

/// The parts that have too little room, with those that touch them: others keep their margins.
std::array<bool, kMaxParts> StepFinder::parts_without_room(const Displacements& wanted) {
  std::array<std::size_t, kMaxParts> group{};  // the least number of the parts that touch each other
  std::iota(group.begin(), group.end(), 0u);
  for (const CoupledRow& row : rows_.rows()) {
    if (row.other < 0) continue;
    const auto [least, other] =
        std::minmax({group[static_cast<std::size_t>(row.part)], group[static_cast<std::size_t>(row.other)]});
    std::replace(group.begin(), group.end(), other, least);
  }
  std::array<bool, kMaxParts> without{};
  for (std::size_t first = 0; first < shared_.count(); ++first) {
    if (group[first] != first) continue;
    rows_of_group_.clear();
    std::copy_if(rows_.rows().begin(), rows_.rows().end(), std::back_inserter(rows_of_group_),
                 [&](const CoupledRow& row) { return group[static_cast<std::size_t>(row.part)] == first; });
    if (!is_too_narrow(solver_.project(shared_.of_parts(wanted), grips_, rows_of_group_))) continue;
    for (std::size_t p = first; p < shared_.count(); ++p)
      without[p] = without[p] || group[p] == first;
  }
  return without;
}

void StepFinder::solve_friction(const Displacements& wanted, WorkBudget& budget) {
  const Friction& friction = shared_.rules.friction;
  coefficients_.clear();
  for (const CoupledRow& row : rows_.rows())
    coefficients_.push_back(slipped(row) ? friction.sliding : friction.at_rest);
  const std::int64_t most = std::max(budget.left / kWorkOfFriction, kLeastFriction * std::ssize(rows_.rows()));
  friction_solver_.solve(shared_.of_parts(wanted), grips_, rows_.rows(), coefficients_, projected_, forces_, most);
  budget.spend(kWorkOfFriction * friction_solver_.evaluations());
  if (!friction_solver_.is_settled()) ++unsettled_friction_;
}

/// Whether the two sides slid past each other in the last call; their common motion does not count.
bool StepFinder::slipped(const CoupledRow& row) const {
  double still = kUnbounded;  // a shorter slip does not count
  double curved = 0.0;        // the error of a step that holds this point to first order
  const auto motion_of = [&](std::int32_t number, const Eigen::Vector3d& r) -> Eigen::Vector3d {
    const HeldPartState& part = shared_.states[static_cast<std::size_t>(number)];
    const Eigen::Isometry3d& X_from = part.X_WV_before_last;
    const Eigen::Isometry3d& X_to = part.X_WV_before;
    const double angle = Eigen::Quaterniond(X_from.linear()).angularDistance(Eigen::Quaterniond(X_to.linear()));
    still = std::min(still, kNotWorthIt * part.margin);
    curved += 0.5 * angle * angle * r.norm();
    const Eigen::Vector3d p_V = part.p_Vref + part.result.X_WV.linear().transpose() * r;
    return X_to.translation() - X_from.translation() + (X_to.linear() - X_from.linear()) * p_V;
  };
  Eigen::Vector3d slip = motion_of(row.part, row.r);
  if (row.other >= 0) slip -= motion_of(row.other, row.r_other);
  slip -= slip.dot(row.n) * row.n;
  return slip.norm() > still + curved;
}

}  // namespace glissade::contact
