#include "sliding/step_finder.h"

#include <algorithm>
#include <cmath>

#include "sliding/allowed_fraction.h"
#include "sliding/energy.h"
#include "sliding/sliding_constants.h"

namespace glissade::haptics {
namespace {

constexpr int kDampings = 4;
constexpr double kLargestDamping = 1e3;
constexpr int kProjections = 4;  // the first, and three more with rows for failed certificates
constexpr int kHalvings = 6;

constexpr CouplingStiffness kImmovable{kUnbounded, kUnbounded};

}  // namespace

StepFinder::StepFinder(SimulatedParts& shared)
    : shared_(shared), rows_(shared), certificate_(shared.scene), grips_(shared.count()) {}

void StepFinder::look(double reach) {
  reach_ = reach;
  rows_.find(reach);
}

Step StepFinder::find() {
  const std::vector<HeldPartState>& parts = shared_.states;
  Displacements wanted;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    grips_[p] = parts[p].is_held() ? parts[p].stiffness : kImmovable;
    if (!parts[p].is_held()) continue;
    wanted[p] = geometry::displacement_between(parts[p].result.X_WV, parts[p].X_WS, parts[p].p_Vref());
  }
  // A step that gains more energy than this has passed a bend of the contact that the linear rows do not describe. It
  // is repeated with damping.
  const double most_energy = energy(parts, wanted) + energy_allowance(parts, wanted, shared_.largest_margin);
  for (int trial = 0; trial < kDampings; ++trial) {
    Displacements damped;
    for (std::size_t p = 0; p < parts.size(); ++p)
      damped[p] = wanted[p].scaled(1.0 / (1.0 + damping_));
    Step step = certified(damped);
    bool all_arrive = true;
    Displacements remaining;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      step.arrives[p] = step.arrives[p] && damping_ == 0.0;
      all_arrive = all_arrive && step.arrives[p];
      if (!parts[p].is_held()) continue;
      const Eigen::Vector3d& p_Vref = parts[p].p_Vref();
      remaining[p] = geometry::displacement_between(
          geometry::displaced(parts[p].result.X_WV, p_Vref, step.displacements[p]), parts[p].X_WS, p_Vref);
    }
    if (all_arrive || energy(parts, remaining) <= most_energy) {
      damping_ = damping_ < 0.1 ? 0.0 : 0.25 * damping_;
      return step;
    }
    damping_ = std::clamp(4.0 * damping_, 0.5, kLargestDamping);
  }
  damping_ = 0.0;
  return {.clipped = true};
}

/// The largest step towards `wanted` that can be certified.
Step StepFinder::certified(const Displacements& wanted) {
  rows_.keep_contacts_only();
  Step step;
  Step first;  // on the contacts alone
  bool is_certified = false;
  int projections = 0;
  for (; projections < kProjections && !is_certified; ++projections) {
    if (projections > 0) rows_.add_failures(failures_);
    if (!project(wanted)) return {.clipped = true};
    const std::array<double, kMaxParts> fractions = allowed_fractions(shared_, projected_, rows_.rows(), reach_);
    Displacements shortened;
    step.clipped = false;
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      shortened[p] = projected_[p].scaled(fractions[p]);
      step.arrives[p] = fractions[p] == 1.0;
      step.clipped = step.clipped || fractions[p] < 1.0;
    }
    is_certified = certify(shortened, step);
    if (projections > 0) continue;
    first = step;
    first_forces_ = forces_;
  }
  // Rows of failed certificates forbid more than necessary. They may leave nothing where a shorter step would be free.
  if (is_certified && projections > 1 && step.length < kNotWorthIt * shared_.largest_margin) {
    is_certified = false;
    step = first;
    forces_ = first_forces_;
  }
  if (!is_certified && !halve_until_certified(step)) return {.clipped = true};
  for (const RowForce& force : forces_) {
    const CoupledRow& row = rows_.rows()[static_cast<std::size_t>(force.row)];
    step.arrives[static_cast<std::size_t>(row.part)] = false;
    if (row.other >= 0) step.arrives[static_cast<std::size_t>(row.other)] = false;
  }
  for (std::size_t p = 0; p < shared_.count(); ++p)
    step.arrives[p] = step.arrives[p] || !shared_.states[p].is_held();
  return step;
}

/// Shortens the parts whose pairs fail; the others go on.
bool StepFinder::halve_until_certified(Step& step) {
  const int attempts = kHalvings + static_cast<int>(shared_.count());
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::array<bool, kMaxParts> fails = parts_that_fail();
    Displacements shortened = step.displacements;
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      if (!fails[p]) continue;
      shortened[p] = shortened[p].scaled(attempt < kHalvings ? 0.5 : 0.0);
      step.arrives[p] = false;
    }
    step.clipped = true;
    if (certify(shortened, step)) return true;
  }
  return false;
}

/// The parts of the pairs that could not be certified; all parts if the candidates did not even cover the step.
std::array<bool, kMaxParts> StepFinder::parts_that_fail() const {
  std::array<bool, kMaxParts> fails{};
  if (failures_.empty()) fails.fill(true);
  const auto obstacles = static_cast<std::int32_t>(shared_.scene.obstacles().size());
  for (const UncertifiedPair& failure : failures_) {
    fails[static_cast<std::size_t>(failure.bodies.part - obstacles)] = true;
    if (failure.bodies.obstacle >= obstacles)
      fails[static_cast<std::size_t>(failure.bodies.obstacle - obstacles)] = true;
  }
  return fails;
}

/// Sets the displacements of `step`, and returns whether they are certified.
bool StepFinder::certify(const Displacements& displacements, Step& step) {
  step.displacements = displacements;
  step.length = 0.0;
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    step.lengths[p] = geometry::motion_bound(displacements[p], shared_.states[p].part_V->radius());
    step.length += step.lengths[p];
  }
  // Bodies farther apart than this keep their minimum clearance whatever happens on the way.
  const double concerned =
      step.length + kMinClearanceOfMargin * shared_.largest_margin + certificate_.certain_distance();
  failures_.clear();
  if (!shared_.candidates.covers(concerned)) return false;
  shared_.candidates.within(concerned, to_certify_);
  return certificate_.prove(shared_.of_parts(displacements), to_certify_, failures_);
}

/// Projects on all rows. Returns false if the solver finds no solution; then the parts stand still.
bool StepFinder::project(const Displacements& wanted) {
  const std::span<const geometry::Displacement> of_parts = shared_.of_parts(wanted);
  CoupledProjection projection = solver_.project(of_parts, grips_, rows_.rows());
  if (projection.status == ProjectionStatus::kInfeasible) {
    // Not every contact can have its margin back.
    rows_.allow_standing_still();
    projection = solver_.project(of_parts, grips_, rows_.rows());
  }
  forces_.clear();
  projected_.fill({});
  if (projection.status != ProjectionStatus::kSolved) return false;
  projected_ = projection.displacements;
  const bool rubs = shared_.rules.friction.is_on() && projection.active_count > 0;
  if (rubs) rows_.recall_forces(forces_);
  if (forces_.empty()) {
    for (int i = 0; i < projection.active_count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      forces_.push_back({projection.active[slot], projection.force[slot]});
    }
  }
  if (rubs) solve_friction(wanted);
  return true;
}

void StepFinder::solve_friction(const Displacements& wanted) {
  const Friction& friction = shared_.rules.friction;
  coefficients_.clear();
  for (const CoupledRow& row : rows_.rows())
    coefficients_.push_back(slipped(row) ? friction.sliding : friction.at_rest);
  friction_solver_.solve(shared_.of_parts(wanted), grips_, rows_.rows(), coefficients_, projected_, forces_);
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
    const Eigen::Vector3d p_V = part.p_Vref() + part.result.X_WV.linear().transpose() * r;
    return X_to.translation() - X_from.translation() + (X_to.linear() - X_from.linear()) * p_V;
  };
  Eigen::Vector3d slip = motion_of(row.part, row.r);
  if (row.other >= 0) slip -= motion_of(row.other, row.r_other);
  slip -= slip.dot(row.n) * row.n;
  return slip.norm() > still + curved;
}

}  // namespace glissade::haptics
