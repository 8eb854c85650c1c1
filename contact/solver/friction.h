#pragma once

/// Coulomb friction for the projection: contacts that push also hold the part back across their normals, by at most the
/// coefficient of friction times the normal force.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/contact/projection.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

/// The force of a projection row on the part.
struct RowForce {
  std::int32_t row;
  double normal;                                       ///< newtons along the normal, positive
  Eigen::Vector3d across_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across the normal
};

/// The quasi-static step with friction: the displacement ξ with
///   K (ξ − ξ*) = Σ λ_i (n_i, r_i × n_i) + Σ (f_i, r_i × f_i), λ_i ≥ 0, λ_i ⟂ (row i − bound),
///   |f_i| ≤ μ λ_i, and where the contact slips, f_i is μ λ_i against the slip of this step.
/// Solved by the augmented Lagrangian and Newton's method of Alart & Curnier (1991), with the cone of De Saxcé: a
/// contact that slips may rise by μ |slip|, so that its force lies in Coulomb's cone and its motion in the dual one.
/// Contacts are first stiff instead of rigid, so that their forces are functions of the displacement; Newton's method
/// with a line search balances them with the springs, in six unknowns a part. Then the forces found are taken for
/// granted, and stiff contacts add what is missing, until nothing is.
///
/// The forces of redundant contacts, such as four feet on a floor, are not unique, but here contacts are stiff in the
/// same measure and begin without forces. So the feet share the load, and a part that fits exactly is not pressed into
/// its seat: forces that only press against each other would hold it by friction for good. Deterministic; reuses its
/// memory. Not thread-safe.
class FrictionSolver {
 public:
  /// `coefficients` has one entry for each row. On entry, `displacements` is the projection without friction. Newton's
  /// method begins there: where the part could stand still as well as move, it mostly finds the motion. Replaces it,
  /// and `forces`, by the solution, or by what is nearest after so many evaluations of contacts, at most
  /// kMostEvaluations of each.
  void solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
             std::span<const CoupledRow> rows, std::span<const double> coefficients,
             std::array<geometry::Displacement, kMaxParts>& displacements, std::vector<RowForce>& forces,
             std::int64_t most_evaluations = std::numeric_limits<std::int64_t>::max());

  /// Of each contact in a solution.
  static constexpr std::int64_t kMostEvaluations = 2000;
  /// Contacts that share the load, unless more are needed to keep all rows.
  static constexpr std::size_t kMostSharing = 32;
  /// Evaluations of contacts in the last solution.
  std::int64_t evaluations() const { return evaluations_; }
  /// Whether the last solution is one: otherwise its forces are not in balance with the springs.
  bool is_settled() const { return is_settled_; }

 private:
  static constexpr int kMostDof = 6 * static_cast<int>(kMaxParts);
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostDof, 1>;  // whitened, six coordinates a part
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostDof, kMostDof>;
  using Jacobian = Eigen::Matrix<double, 6, 3>;  // columns: normal and two tangents, whitened

  struct Row {
    std::int32_t number;
    Eigen::Index part;   // its first coordinate
    Eigen::Index other;  // likewise; −1: an obstacle
    Jacobian J_part;
    Jacobian J_other;
    double bound;
    double coefficient;
    double response;                               // motion for a force of 1 N, the mean of three directions
    Eigen::Vector3d force_contact{0.0, 0.0, 0.0};  // N: along the normal and the tangents
    Eigen::Matrix<double, 3, 2> tangents_W;

    Eigen::Vector3d motion(const Vector& y) const;
  };

  /// How far springs and stiff contacts are from balance at some displacements.
  struct Balance {
    Vector excess;
    Matrix derivative;
  };

  /// A row that may carry forces from the beginning.
  struct Touching {
    std::size_t row;
    double unlike;  // square of a distance, metres, from the rows that were chosen
  };

  void choose_rows(std::span<const geometry::Displacement> displacements, double tolerance,
                   std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows,
                   std::span<const double> coefficients);
  std::optional<std::size_t> most_violated(std::span<const geometry::Displacement> displacements, double tolerance,
                                           std::span<const CouplingStiffness> stiffness,
                                           std::span<const CoupledRow> rows) const;
  void add_row(std::size_t number, std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows,
               std::span<const double> coefficients);
  bool find_balance(Vector& y, double tolerance);
  double stiffness_of(const Row& row) const { return penalty_ / row.response; }
  Eigen::Vector3d stiff_force(const Row& row, const Eigen::Vector3d& motion) const;
  bool may_go_on() const;
  Vector excess_at(const Vector& y);
  Balance balance_at(const Vector& y);
  double update_forces(const Vector& y);

  std::vector<Row> rows_;        // those that may carry forces
  std::vector<bool> is_chosen_;  // each given row: whether it is one of them
  std::vector<Touching> touching_;
  Vector y_wanted_;
  double penalty_ = 0.0;
  std::int64_t evaluations_ = 0;
  std::int64_t most_evaluations_ = 0;
  bool is_settled_ = true;
};

}  // namespace glissade::contact
