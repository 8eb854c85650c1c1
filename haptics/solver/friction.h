#pragma once

/// Coulomb friction for the projection: contacts that push also hold the part back across their normals, by at most the
/// coefficient of friction times the normal force.

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

#include "solver/projection.h"

namespace glissade::haptics {

/// The force of a projection row on the part.
struct RowForce {
  std::int32_t row;
  double normal;                                       ///< newtons along the normal, positive
  Eigen::Vector3d across_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across the normal
};

/// The quasi-static step with friction: the displacement ξ with
///   K (ξ − ξ*) = Σ λ_i (n_i, r_i × n_i) + Σ (f_i, r_i × f_i), λ_i ≥ 0, λ_i ⟂ (row i − bound),
///   |f_i| ≤ μ λ_i, and where the contact slips, f_i is μ λ_i against the slip of this step.
/// Solved by block Gauss–Seidel over the contacts, with the friction disc itself instead of a pyramid. The normal
/// forces of redundant contacts, such as four feet on a floor, are not unique; their sum is.
/// Deterministic; reuses its memory. Not thread-safe.
class FrictionSolver {
 public:
  /// `coefficients` has one entry for each row. Replaces `displacements` and `forces` by the solution. On entry
  /// `forces` has the starting point: the forces of the last step, or else those of the frictionless programme. From a
  /// poor starting point a sticking part would creep in every step by the error that the sweeps leave. Cost O(rows),
  /// plus up to some hundred sweeps over the contacts that push.
  void solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
             std::span<const CoupledRow> rows, std::span<const double> coefficients,
             std::array<geometry::Displacement, kMaxParts>& displacements, std::vector<RowForce>& forces);

 private:
  using Jacobian = Eigen::Matrix<double, 6, 3>;  // columns: normal and two tangents, whitened

  struct Row {
    std::int32_t part;
    std::int32_t other;
    Jacobian J_part;
    Jacobian J_other;
    double bound;
    double coefficient;
    double normal_response;            // motion along the normal for a force of 1 N
    Eigen::Matrix2d response;          // the same across the normal
    Eigen::Matrix2d inverse_response;  // its inverse
    double largest_response;           // its largest eigenvalue
    Eigen::Vector3d force_contact;     // N: along the normal and the tangents
    Eigen::Matrix<double, 3, 2> tangents_W;
    bool in_working_set;  // pushes, or has been violated
  };

  void prepare(std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows,
               std::span<const double> coefficients);
  double sweep();
  double relax(Row& row);
  bool extend_working_set(double tolerance);
  void push(const Row& row, const Eigen::Vector3d& force_contact);

  std::vector<Row> rows_;
  std::array<geometry::Vector6d, kMaxParts> y_;  // whitened displacements
};

}  // namespace glissade::haptics
