#include "solver/friction.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <glissade/base/assert.h>

namespace glissade::contact {
namespace {

constexpr double kSettled = 1e-8;  // of the wanted displacement
constexpr int kMostUpdates = 50;
constexpr int kMostHalvings = 10;
constexpr double kEnoughDescent = 0.1;  // of that which a step promises

/// Stiffness of contacts, in multiples of that of the hold at the contact: it grows tenfold with each update. The
/// forces make up for what the last one lacks.
constexpr double kFirstPenalty = 1e2;
constexpr double kLastPenalty = 1e5;

/// Of rows that may share the load: how unlike those that do they are. Nothing is like the first of two bodies.
constexpr double kUnlike = std::numeric_limits<double>::infinity();
constexpr double kChosen = -1.0;

/// A displacement in the metric of K, and back. A part of infinite stiffness stands still.
Eigen::Matrix<double, 6, 1> whitened(const geometry::Displacement& d, const CouplingStiffness& k) {
  Eigen::Matrix<double, 6, 1> y = Eigen::Matrix<double, 6, 1>::Zero();
  if (std::isfinite(k.translational)) y << std::sqrt(k.translational) * d.v, std::sqrt(k.rotational) * d.w;
  return y;
}

geometry::Displacement displacement(const Eigen::Matrix<double, 6, 1>& y, const CouplingStiffness& k) {
  return {y.head<3>() / std::sqrt(k.translational), y.tail<3>() / std::sqrt(k.rotational)};
}

std::array<geometry::Displacement, kMaxParts> displacements_at(const auto& y,
                                                               std::span<const CouplingStiffness> stiffness) {
  std::array<geometry::Displacement, kMaxParts> displacements{};
  for (std::size_t p = 0; p < stiffness.size(); ++p)
    displacements[p] = displacement(y.template segment<6>(static_cast<Eigen::Index>(6 * p)), stiffness[p]);
  return displacements;
}

/// `Row::response` of a row that may have no part in the forces.
double response(const CoupledRow& row, std::span<const CouplingStiffness> stiffness) {
  const auto of_part = [&](std::int32_t part, const Eigen::Vector3d& r) {
    const CouplingStiffness& k = stiffness[static_cast<std::size_t>(part)];
    return 1.0 / k.translational + 2.0 / 3.0 * r.squaredNorm() / k.rotational;
  };
  return of_part(row.part, row.r) + (row.other < 0 ? 0.0 : of_part(row.other, row.r_other));
}

/// Metres: the lever at which the part's hold is as stiff against rotation as against translation.
double radius_of_hold(const CoupledRow& row, std::span<const CouplingStiffness> stiffness) {
  const CouplingStiffness& own = stiffness[static_cast<std::size_t>(row.part)];
  const bool is_held = std::isfinite(own.translational);
  const CouplingStiffness& k = is_held || row.other < 0 ? own : stiffness[static_cast<std::size_t>(row.other)];
  return std::sqrt(k.rotational / k.translational);
}

/// The directions n, t, t' at a point, as whitened displacements of a part.
Eigen::Matrix<double, 6, 3> whitened(const Eigen::Matrix3d& directions_W, const Eigen::Vector3d& r,
                                     const CouplingStiffness& k) {
  Eigen::Matrix<double, 6, 3> J;
  J.topRows<3>() = directions_W / std::sqrt(k.translational);
  for (int i = 0; i < 3; ++i)
    J.col(i).tail<3>() = r.cross(directions_W.col(i)) / std::sqrt(k.rotational);
  return J;
}

/// The nearest force in Coulomb's cone.
struct ForceInCone {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // along the normal and the tangents
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
};

ForceInCone within_cone(const Eigen::Vector3d& force, double coefficient) {
  const double normal = force.x();
  const double across = force.tail<2>().norm();
  if (coefficient * across <= -normal) return {};
  if (across <= coefficient * normal) return {force, Eigen::Matrix3d::Identity()};
  const Eigen::Vector2d direction = force.tail<2>() / across;
  Eigen::Vector3d edge;  // of the cone, towards the force
  edge << 1.0, coefficient * direction;
  const double share = 1.0 / edge.squaredNorm();
  const double nearest = share * edge.dot(force);
  ForceInCone in_cone{nearest * edge, share * edge * edge.transpose()};
  in_cone.derivative.bottomRightCorner<2, 2>() +=
      coefficient * nearest / across * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  return in_cone;
}

}  // namespace

void FrictionSolver::solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
                           std::span<const CoupledRow> rows, std::span<const double> coefficients,
                           std::array<geometry::Displacement, kMaxParts>& displacements, std::vector<RowForce>& forces,
                           std::int64_t most_evaluations) {
  GLISSADE_ASSERT(coefficients.size() == rows.size() && stiffness.size() == wanted.size());
  Vector y(6 * std::ssize(wanted));
  y_wanted_.resize(y.size());
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    const auto first = static_cast<Eigen::Index>(6 * p);
    y_wanted_.segment<6>(first) = whitened(wanted[p], stiffness[p]);
    y.segment<6>(first) = whitened(displacements[p], stiffness[p]);
  }
  double size = std::max(y_wanted_.norm(), y.norm());
  for (const CoupledRow& row : rows) {
    if (row.bound > 0.0) size = std::max(size, row.bound / std::sqrt(response(row, stiffness)));
  }
  const double tolerance = kSettled * size;
  choose_rows(displacements, size / kLastPenalty, stiffness, rows, coefficients);
  penalty_ = kFirstPenalty;
  evaluations_ = 0;
  most_evaluations_ = most_evaluations;
  is_settled_ = false;
  for (int updates = 0; updates < kMostUpdates && !is_settled_ && may_go_on(); ++updates) {
    const bool is_balanced = find_balance(y, tolerance);
    if (update_forces(y) <= tolerance && is_balanced) {
      const auto violated = most_violated(displacements_at(y, stiffness), tolerance, stiffness, rows);
      is_settled_ = !violated;
      if (violated) add_row(*violated, stiffness, rows, coefficients);
      updates = 0;
    }
    penalty_ = std::min(10.0 * penalty_, kLastPenalty);
  }

  displacements = displacements_at(y, stiffness);
  forces.clear();
  for (const Row& row : rows_) {
    if (row.force_contact.x() <= 0.0) continue;
    forces.push_back({row.number, row.force_contact.x(), row.tangents_W * row.force_contact.tail<2>()});
  }
}

/// Takes all rows if they are few. Otherwise takes some of those that touch at these displacements: one after the
/// other, each time the one that is least like those before in place and normal.
void FrictionSolver::choose_rows(std::span<const geometry::Displacement> displacements, double tolerance,
                                 std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows,
                                 std::span<const double> coefficients) {
  rows_.clear();
  is_chosen_.assign(rows.size(), false);
  touching_.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CoupledRow& row = rows[i];
    if (!std::isfinite(row.bound)) continue;
    if (rows.size() <= kMostSharing) {
      add_row(i, stiffness, rows, coefficients);
    } else if (row.velocity(displacements) - row.bound <= tolerance * std::sqrt(response(row, stiffness))) {
      touching_.push_back({i, kUnlike});
    }
  }
  const std::size_t count = std::min(touching_.size(), kMostSharing);
  for (auto next = touching_.begin(); rows_.size() < count;) {
    const CoupledRow& chosen = rows[next->row];
    add_row(next->row, stiffness, rows, coefficients);
    const double radius = radius_of_hold(chosen, stiffness);
    for (Touching& touching : touching_) {
      const CoupledRow& row = rows[touching.row];
      if (row.part != chosen.part || row.other != chosen.other) continue;
      const double unlike = (row.r - chosen.r).squaredNorm() + radius * radius * (row.n - chosen.n).squaredNorm();
      touching.unlike = std::min(touching.unlike, unlike);
    }
    next->unlike = kChosen;
    next = std::max_element(touching_.begin(), touching_.end(),
                            [](const Touching& a, const Touching& b) { return a.unlike < b.unlike; });
  }
}

/// The row that these displacements violate most, if any.
std::optional<std::size_t> FrictionSolver::most_violated(std::span<const geometry::Displacement> displacements,
                                                         double tolerance, std::span<const CouplingStiffness> stiffness,
                                                         std::span<const CoupledRow> rows) const {
  std::optional<std::size_t> worst;
  double most = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double missing = rows[i].bound - rows[i].velocity(displacements);
    if (is_chosen_[i] || missing <= most || missing <= tolerance * std::sqrt(response(rows[i], stiffness))) continue;
    most = missing;
    worst = i;
  }
  return worst;
}

void FrictionSolver::add_row(std::size_t number, std::span<const CouplingStiffness> stiffness,
                             std::span<const CoupledRow> rows, std::span<const double> coefficients) {
  is_chosen_[number] = true;
  const CoupledRow& given = rows[number];
  Eigen::Matrix3d directions_W;
  directions_W.col(0) = given.n;
  directions_W.col(1) = given.n.unitOrthogonal();
  directions_W.col(2) = given.n.cross(directions_W.col(1));
  Row& row = rows_.emplace_back();
  row.number = static_cast<std::int32_t>(number);
  row.part = 6 * given.part;
  row.other = given.other < 0 ? -1 : 6 * given.other;
  row.J_part = whitened(directions_W, given.r, stiffness[static_cast<std::size_t>(given.part)]);
  row.J_other.setZero();
  if (given.other >= 0) {
    row.J_other = -whitened(directions_W, given.r_other, stiffness[static_cast<std::size_t>(given.other)]);
  }
  row.bound = given.bound;
  row.coefficient = coefficients[number];
  row.response = (row.J_part.squaredNorm() + row.J_other.squaredNorm()) / 3.0;
  row.tangents_W = directions_W.rightCols<2>();
}

/// Newton's method for the displacements at which springs and stiff contacts are in balance. Returns whether it found
/// them.
bool FrictionSolver::find_balance(Vector& y, double tolerance) {
  while (may_go_on()) {
    const Balance balance = balance_at(y);
    const double excess = balance.excess.norm();
    if (excess <= tolerance) return true;
    const Vector way = -balance.derivative.partialPivLu().solve(balance.excess);
    if (!way.allFinite()) return false;
    double fraction = 1.0;
    const auto is_enough = [&] {
      return excess_at(y + fraction * way).norm() <= (1.0 - kEnoughDescent * fraction) * excess;
    };
    for (int i = 0; i < kMostHalvings && !is_enough(); ++i)
      fraction *= 0.5;
    y += fraction * way;  // however small: the next piece of a function with bends may be an easier one
  }
  return false;
}

bool FrictionSolver::may_go_on() const {
  return evaluations_ < std::min(most_evaluations_, kMostEvaluations * std::max<std::int64_t>(1, std::ssize(rows_)));
}

Eigen::Vector3d FrictionSolver::Row::motion(const Vector& y) const {
  Eigen::Vector3d u = J_part.transpose() * y.segment<6>(part);
  if (other >= 0) u += J_other.transpose() * y.segment<6>(other);
  return u;
}

/// The force of a contact that is stiff instead of rigid, before it is brought into the cone.
Eigen::Vector3d FrictionSolver::stiff_force(const Row& row, const Eigen::Vector3d& motion) const {
  Eigen::Vector3d too_far = motion;
  too_far.x() += row.coefficient * motion.tail<2>().norm() - row.bound;
  return row.force_contact - stiffness_of(row) * too_far;
}

FrictionSolver::Vector FrictionSolver::excess_at(const Vector& y) {
  evaluations_ += std::ssize(rows_);
  Vector excess = y - y_wanted_;
  for (const Row& row : rows_) {
    const Eigen::Vector3d force = within_cone(stiff_force(row, row.motion(y)), row.coefficient).force;
    excess.segment<6>(row.part) -= row.J_part * force;
    if (row.other >= 0) excess.segment<6>(row.other) -= row.J_other * force;
  }
  return excess;
}

FrictionSolver::Balance FrictionSolver::balance_at(const Vector& y) {
  evaluations_ += std::ssize(rows_);
  Balance balance{y - y_wanted_, Matrix::Identity(y.size(), y.size())};
  const auto add = [&](Eigen::Index a, const Jacobian& J_a, const Eigen::Matrix3d& stiffness, Eigen::Index b,
                       const Jacobian& J_b) {
    balance.derivative.block<6, 6>(a, b) += J_a * stiffness * J_b.transpose();
  };
  for (const Row& row : rows_) {
    const Eigen::Vector3d motion = row.motion(y);
    const ForceInCone in_cone = within_cone(stiff_force(row, motion), row.coefficient);
    if (in_cone.force.isZero(0.0)) continue;
    Eigen::Matrix3d stiffness = stiffness_of(row) * in_cone.derivative;
    const double slip = motion.tail<2>().norm();
    if (slip > 0.0)
      stiffness.rightCols<2>() += row.coefficient / slip * stiffness.col(0) * motion.tail<2>().transpose();
    balance.excess.segment<6>(row.part) -= row.J_part * in_cone.force;
    add(row.part, row.J_part, stiffness, row.part, row.J_part);
    if (row.other < 0) continue;
    balance.excess.segment<6>(row.other) -= row.J_other * in_cone.force;
    add(row.other, row.J_other, stiffness, row.other, row.J_other);
    add(row.part, row.J_part, stiffness, row.other, row.J_other);
    add(row.other, row.J_other, stiffness, row.part, row.J_part);
  }
  return balance;
}

/// Takes the forces of these displacements. Returns by how much the motion of a contact may still change, in the metric
/// of K.
double FrictionSolver::update_forces(const Vector& y) {
  double change = 0.0;
  for (Row& row : rows_) {
    const Eigen::Vector3d force = within_cone(stiff_force(row, row.motion(y)), row.coefficient).force;
    change = std::max(change, (force - row.force_contact).norm() / stiffness_of(row) / std::sqrt(row.response));
    row.force_contact = force;
  }
  return change;
}

}  // namespace glissade::contact
