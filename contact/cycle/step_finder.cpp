#include "cycle/step_finder.h"

#include <algorithm>
#include <cmath>

#include "cycle/allowed_fraction.h"
#include "cycle/energy.h"
#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

constexpr int kDampings = 4;
constexpr double kLargestDamping = 1e3;
constexpr int kProjections = 4;  // the first, and three more with rows for failed certificates
constexpr int kHalvings = 6;

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
    : shared_(shared), rows_(shared), projection_(shared, rows_), certificate_(shared.scene) {}

void StepFinder::look(double reach, double reach_ahead, WorkBudget& budget) {
  reach_ = reach;
  rows_.find(reach, reach_ahead, budget);
}

std::optional<Step> StepFinder::find(WorkBudget& budget) {
  if (!is_under_way_) begin(budget);
  while (is_under_way_) {
    if (!certificate_.go_on(budget) || budget.is_used_up()) return std::nullopt;
    shared_.candidates.pairs().note_planes(certificate_.separated());
    bool is_free = is_covered_ && certificate_.failures().empty();
    if (halvings_ == 0) {
      note_first();
      if (!is_free && projections_ < kProjections) {
        rows_.add_failures(certificate_.failures());
        try_projection(budget);
        continue;
      }
      if (falls_back_to_first()) is_free = false;
    }
    if (is_free) {
      note_arrivals();
      end_trial(budget);
    } else if (halvings_ < kHalvings + static_cast<int>(shared_.count())) {
      try_half(budget);
    } else {
      step_ = {.clipped = true};
      end_trial(budget);
    }
  }
  return step_;
}

std::array<double, kMaxParts> StepFinder::find_forces(WorkBudget& budget) {
  projection_.aim();
  rows_.keep_contacts_only();
  Displacements left;
  do {
    if (!project(projection_.wanted(), budget)) return {};
    left = shorten();
  } while (rows_.find_violated(left, budget));
  std::array<double, kMaxParts> lengths{};
  for (std::size_t p = 0; p < shared_.count(); ++p)
    lengths[p] = geometry::motion_bound(left[p], shared_.states[p].lever);
  return lengths;
}

/// Begins to look for a step.
void StepFinder::begin(WorkBudget& budget) {
  projection_.aim();
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
  const Displacements& wanted = projection_.wanted();
  most_energy_ = energy(parts, wanted);
  if (!all_stay || !is_restless) most_energy_ += energy_allowance(parts, wanted, shared_.largest_margin);
  trial_ = 0;
  is_under_way_ = true;
  begin_trial(budget);
}

void StepFinder::begin_trial(WorkBudget& budget) {
  damped_ = {};
  for (std::size_t p = 0; p < shared_.count(); ++p)
    damped_[p] = projection_.wanted()[p].scaled(1.0 / (1.0 + damping_));
  rows_.keep_contacts_only();
  projections_ = 0;
  halvings_ = 0;
  try_projection(budget);
}

/// Projects on all rows, with the forces of the contacts.
bool StepFinder::project(const Displacements& towards, WorkBudget& budget) {
  const bool is_solved = projection_.project(towards, budget);
  forces_ = projection_.forces();
  return is_solved;
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
    if (!step_.clipped && damping_ == 0.0 && projection_.is_worth_another(shortened)) {
      is_first_order_ = !projection_.project_again(budget);
      forces_ = projection_.forces();
      shortened = shorten();
    }
  } while (rows_.find_violated(shortened, budget));
  ++projections_;
  begin_certificate(shortened, budget);
}

/// The projected displacements, as far as they may lead. Begins the step with what is known of it then.
Displacements StepFinder::shorten() {
  Displacements shortened;
  const AllowedFractions allowed = allowed_fractions(shared_, projection_.displacements(), rows_, reach_);
  step_ = {};
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    const double fraction = allowed.of_parts[p];
    shortened[p] = projection_.displacements()[p].scaled(fraction);
    step_.missed[p] = projection_.displacements()[p].scaled(allowed.beyond_reach[p] - fraction);
    step_.arrives[p] = fraction == 1.0;
    step_.clipped = step_.clipped || fraction < 1.0;
    step_.is_reach_short = step_.is_reach_short || fraction < allowed.beyond_reach[p];
  }
  keep_covered(shortened);
  return shortened;
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

/// Keeps the step on the contacts alone.
void StepFinder::note_first() {
  if (projections_ != 1) return;
  first_ = step_;
  first_forces_ = forces_;
}

/// Rows of failed certificates forbid more than necessary. They may leave nothing where a shorter step would be free:
/// then the first step is the one to shorten.
bool StepFinder::falls_back_to_first() {
  if (projections_ == 1 || step_.length >= kNotWorthIt * shared_.largest_margin) return false;
  step_ = first_;
  forces_ = first_forces_;
  return true;
}

/// Shortens the parts whose pairs fail; the others go on.
void StepFinder::try_half(WorkBudget& budget) {
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
    is_under_way_ = false;
    return;
  }
  damping_ = std::clamp(4.0 * damping_, 0.5, kLargestDamping);
  if (++trial_ < kDampings) {
    begin_trial(budget);
    return;
  }
  damping_ = 0.0;
  step_ = {.clipped = true};
  is_under_way_ = false;
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

}  // namespace glissade::contact
