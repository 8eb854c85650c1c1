#pragma once

/// Coulomb friction for the projection: contacts that push also hold the part back across their normals, by no more
/// than the coefficient times what they push with.

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

#include "solver/projection.h"

namespace glissade::haptics {

/// What a row of the projection does to the parts.
struct RowForce {
  std::int32_t row;
  double normal;                                       ///< newtons along the normal, positive
  Eigen::Vector3d across_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across the normal
};

/// The quasi-static step with friction: the displacement ξ with
///   K (ξ* − ξ) = Σ λ_i (n_i, r_i × n_i) + Σ (f_i, r_i × f_i) up to sign, λ_i ≥ 0, λ_i ⟂ (row i − bound),
///   |f_i| ≤ μ λ_i, and where the contact slips, f_i is μ λ_i against the slip of this step.
/// Solved by block Gauss–Seidel over the contacts, with the disc of friction as it is and not as a pyramid. The normal
/// forces of contacts that are redundant, such as four feet on a floor, are not unique; their sum is.
/// Deterministic; reuses its memory. Not thread-safe.
class FrictionSolver {
 public:
  /// `coefficients` has one for each row. Replaces `displacements` by the solution and `forces`, which it starts from,
  /// by its forces: those of the step before, or else of the frictionless programme. Without a good start a part that
  /// sticks would creep by what the sweeps leave undone, each time. Cost O(rows) and up to some hundred sweeps over the
  /// contacts that push.
  void solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
             std::span<const CoupledRow> rows, std::span<const double> coefficients,
             std::array<geometry::Displacement, kMaxParts>& displacements, std::vector<RowForce>& forces);

 private:
  using Jacobian = Eigen::Matrix<double, 6, 3>;  // columns: the normal and two tangents, whitened

  struct Row {
    std::int32_t part;
    std::int32_t other;
    Jacobian J_part;
    Jacobian J_other;
    double bound;
    double coefficient;
    double normal_response;            // of the slip to a force of 1 N
    Eigen::Matrix2d response;          // the same across the normal
    Eigen::Matrix2d inverse_response;  // its inverse
    double largest_response;           // its largest eigenvalue
    Eigen::Vector3d force_contact;     // N: along the normal and the tangents
    Eigen::Matrix<double, 3, 2> tangents_W;
    bool in_working_set;  // pushes, or has been in the way
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
