#include "cycle/step_projection.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "cycle/energy.h"
#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

// Work of a projection, in the unit of `collision::WorkMeter`: rough. Steps take 0.4 ns a unit.
constexpr std::int64_t kWorkOfProjection = 500;
constexpr std::int64_t kWorkOfRow = 50;
constexpr std::int64_t kWorkOfFriction = 60;  // of an evaluation of a contact
/// Evaluations of each contact that shares the load, however little work is left.
constexpr std::int64_t kLeastFriction = 40;

constexpr CouplingStiffness kImmovable{kUnbounded, kUnbounded};

}  // namespace

StepProjection::StepProjection(SimulatedParts& shared, ContactRows& rows)
    : shared_(shared), rows_(rows), turned_rows_(shared), grips_(shared.count()) {}

/// Sets the wanted displacements.
void StepProjection::aim() {
  const std::vector<HeldPartState>& parts = shared_.states;
  wanted_ = {};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    grips_[p] = parts[p].is_held() ? parts[p].stiffness : kImmovable;
    if (!parts[p].is_held()) continue;
    wanted_[p] = geometry::displacement_between(parts[p].result.X_WV, parts[p].X_WS, parts[p].p_Vref);
  }
}

/// Projects on all rows. Returns false if the solver finds no solution; then the parts stand still.
bool StepProjection::project(const Displacements& towards, WorkBudget& budget) {
  const std::span<const geometry::Displacement> of_parts = shared_.of_parts(towards);
  const std::int64_t work = kWorkOfProjection + kWorkOfRow * std::ssize(rows_.rows());
  budget.spend(work);
  CoupledProjection projection = solver_.project(of_parts, grips_, rows_.rows());
  if (is_too_narrow(projection)) {
    rows_.use_room(parts_without_room(towards));
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
  if (shared_.rules.friction.is_on() && !forces_.empty()) solve_friction(towards, budget);
  return true;
}

/// Whether not every contact can have its margin back, or only for more energy of the springs than a margin is worth.
bool StepProjection::is_too_narrow(const CoupledProjection& projection) const {
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
std::array<bool, kMaxParts> StepProjection::parts_without_room(const Displacements& towards) {
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
    if (!is_too_narrow(solver_.project(shared_.of_parts(towards), grips_, rows_of_group_))) continue;
    for (std::size_t p = first; p < shared_.count(); ++p)
      without[p] = without[p] || group[p] == first;
  }
  return without;
}

void StepProjection::solve_friction(const Displacements& towards, WorkBudget& budget) {
  const Friction& friction = shared_.rules.friction;
  coefficients_.clear();
  for (const CoupledRow& row : rows_.rows())
    coefficients_.push_back(slipped(row) ? friction.sliding : friction.at_rest);
  const std::size_t sharing = std::min(rows_.rows().size(), FrictionSolver::kMostSharing);
  const std::int64_t most =
      std::max(budget.left / kWorkOfFriction, kLeastFriction * static_cast<std::int64_t>(sharing));
  budget.spend(kWorkOfRow * std::ssize(rows_.rows()));
  friction_solver_.solve(shared_.of_parts(towards), grips_, rows_.rows(), coefficients_, projected_, forces_, most);
  budget.spend(kWorkOfFriction * friction_solver_.evaluations());
  if (!friction_solver_.is_settled()) ++unsettled_friction_;
}

/// Whether the two sides slid past each other in the last call; their common motion does not count.
bool StepProjection::slipped(const CoupledRow& row) const {
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

/// Whether the projected displacements turn the contacts so far that another projection would change them by as much as
/// a step that counts: the forces turn with the contacts, and gaps change to second order.
bool StepProjection::is_worth_another(const Displacements& displacements) const {
  if (forces_.empty() || shared_.rules.friction.is_on()) return false;
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
bool StepProjection::project_again(WorkBudget& budget) {
  budget.spend(kWorkOfProjection + kWorkOfRow * std::ssize(rows_.rows()));
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

void StepProjection::set_forces(const CoupledProjection& projection) {
  forces_.clear();
  for (int i = 0; i < projection.active_count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    forces_.push_back({projection.active[slot], projection.force[slot]});
  }
}

}  // namespace glissade::contact
