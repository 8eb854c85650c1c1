#include "solver/friction.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <glissade/base/assert.h>

namespace glissade::haptics {
namespace {

constexpr int kMostSweeps = 500;
constexpr int kMostExtensions = 8;
constexpr double kSettled = 1e-10;  // of the wanted displacement

/// The directions n, t, t' at a point, as whitened displacements of a part.
Eigen::Matrix<double, 6, 3> whitened(const Eigen::Matrix3d& directions_W, const Eigen::Vector3d& r,
                                     const CouplingStiffness& stiffness) {
  Eigen::Matrix<double, 6, 3> J;
  J.topRows<3>() = directions_W / std::sqrt(stiffness.translational);
  for (int k = 0; k < 3; ++k)
    J.col(k).tail<3>() = r.cross(directions_W.col(k)) / std::sqrt(stiffness.rotational);
  return J;
}

}  // namespace

void FrictionSolver::solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
                           std::span<const CoupledRow> rows, std::span<const double> coefficients,
                           std::array<geometry::Displacement, kMaxParts>& displacements,
                           std::vector<RowForce>& forces) {
  GLISSADE_ASSERT(coefficients.size() == rows.size() && stiffness.size() == wanted.size());
  prepare(stiffness, rows, coefficients);
  double size = 0.0;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    y_[p].setZero();
    if (!std::isfinite(stiffness[p].translational)) continue;
    y_[p] << std::sqrt(stiffness[p].translational) * wanted[p].v, std::sqrt(stiffness[p].rotational) * wanted[p].w;
    size = std::max(size, y_[p].norm());
  }
  for (const RowForce& force : forces) {
    Row& row = rows_[static_cast<std::size_t>(force.row)];
    row.force_contact << force.normal, row.tangents_W.transpose() * force.across_W;
    row.in_working_set = true;
    push(row, row.force_contact);
  }
  for (int extension = 0; extension < kMostExtensions; ++extension) {
    for (int i = 0; i < kMostSweeps; ++i) {
      if (sweep() <= kSettled * size) break;
    }
    if (!extend_working_set(kSettled * size)) break;
  }

  for (std::size_t p = 0; p < wanted.size(); ++p) {
    displacements[p] = {y_[p].head<3>() / std::sqrt(stiffness[p].translational),
                        y_[p].tail<3>() / std::sqrt(stiffness[p].rotational)};
  }
  forces.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (!(row.force_contact.x() > 0.0)) continue;
    forces.push_back(
        {static_cast<std::int32_t>(i), row.force_contact.x(), row.tangents_W * row.force_contact.tail<2>()});
  }
}

void FrictionSolver::prepare(std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows,
                             std::span<const double> coefficients) {
  rows_.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CoupledRow& given = rows[i];
    Row& row = rows_[i];
    Eigen::Matrix3d directions_W;
    directions_W.col(0) = given.n;
    directions_W.col(1) = given.n.unitOrthogonal();
    directions_W.col(2) = given.n.cross(directions_W.col(1));
    row.part = given.part;
    row.other = given.other;
    row.J_part = whitened(directions_W, given.r, stiffness[static_cast<std::size_t>(given.part)]);
    row.J_other.setZero();
    if (given.other >= 0) {
      row.J_other = -whitened(directions_W, given.r_other, stiffness[static_cast<std::size_t>(given.other)]);
    }
    const Eigen::Matrix3d response = row.J_part.transpose() * row.J_part + row.J_other.transpose() * row.J_other;
    row.bound = given.bound;
    row.coefficient = coefficients[i];
    row.normal_response = response(0, 0);
    row.response = response.bottomRightCorner<2, 2>();
    row.inverse_response = row.response.inverse();
    const double mean = 0.5 * row.response.trace();
    row.largest_response = mean + std::sqrt(std::max(0.0, mean * mean - row.response.determinant()));
    row.force_contact.setZero();
    row.tangents_W = directions_W.rightCols<2>();
    row.in_working_set = false;
  }
}

/// Relaxes every row of the working set once. Returns the largest change of the displacements, in the metric of K.
double FrictionSolver::sweep() {
  double change = 0.0;
  for (Row& row : rows_) {
    if (row.in_working_set) change = std::max(change, relax(row));
  }
  return change;
}

/// Makes one contact consistent with the present forces of the others. Returns the change of the displacements, in the
/// metric of K.
double FrictionSolver::relax(Row& row) {
  const auto motion = [&]() -> Eigen::Vector3d {
    Eigen::Vector3d u = row.J_part.transpose() * y_[static_cast<std::size_t>(row.part)];
    if (row.other >= 0) u += row.J_other.transpose() * y_[static_cast<std::size_t>(row.other)];
    return u;
  };
  Eigen::Vector3d change = Eigen::Vector3d::Zero();
  const double normal = row.force_contact.x();
  change.x() = std::max(0.0, normal - (motion().x() - row.bound) / row.normal_response) - normal;
  push(row, change);

  const Eigen::Vector2d across = row.force_contact.tail<2>();
  const double most = row.coefficient * (normal + change.x());
  const Eigen::Vector2d slip = motion().tail<2>();
  Eigen::Vector2d held = across - row.inverse_response * slip;
  if (held.norm() > most) {
    held = across - slip / row.largest_response;
    if (held.norm() > most) held *= most / held.norm();
  }
  const Eigen::Vector3d change_across(0.0, held.x() - across.x(), held.y() - across.y());
  push(row, change_across);
  row.force_contact += change + change_across;
  return std::sqrt(change.x() * change.x() * row.normal_response + change_across.squaredNorm() * row.largest_response);
}

/// Adds violated rows to the working set. Returns whether there were any.
bool FrictionSolver::extend_working_set(double tolerance) {
  bool found = false;
  for (Row& row : rows_) {
    if (row.in_working_set) continue;
    double motion = row.J_part.col(0).dot(y_[static_cast<std::size_t>(row.part)]);
    if (row.other >= 0) motion += row.J_other.col(0).dot(y_[static_cast<std::size_t>(row.other)]);
    if (motion - row.bound >= -tolerance * std::sqrt(row.normal_response)) continue;
    row.in_working_set = true;
    found = true;
  }
  return found;
}

void FrictionSolver::push(const Row& row, const Eigen::Vector3d& force_contact) {
  y_[static_cast<std::size_t>(row.part)] += row.J_part * force_contact;
  if (row.other >= 0) y_[static_cast<std::size_t>(row.other)] += row.J_other * force_contact;
}

}  // namespace glissade::haptics
