#pragma once

/// The displacements of all parts, nearest to those that they want, which the rows of contacts allow; with friction,
/// and with the forces of the contacts.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>

#include "cycle/contact_rows.h"
#include "cycle/simulated_parts.h"
#include "cycle/turned_rows.h"
#include "solver/friction.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// Not thread-safe.
class StepProjection {
 public:
  /// Both must outlive this object.
  StepProjection(SimulatedParts& shared, ContactRows& rows);

  /// Sets the wanted displacements: to the poses at which the held parts aim.
  void aim();
  const Displacements& wanted() const { return wanted_; }

  /// Projects these displacements, such as a part of the wanted ones, on all rows. Returns false if the solver finds no
  /// solution; then the parts stand still.
  bool project(const Displacements& towards, WorkBudget& budget);
  /// Whether displacements like the projected ones turn the contacts so far that another projection would change them
  /// by as much as a step that counts: the forces turn with the contacts, and gaps change to second order.
  bool is_worth_another(const Displacements& displacements) const;
  /// Projects what is left of the wanted displacements after the projected ones on the rows as they are there, and adds
  /// it to them. Returns false if the solver finds no solution; then nothing changes.
  bool project_again(WorkBudget& budget);

  const Displacements& displacements() const { return projected_; }
  const std::vector<RowForce>& forces() const { return forces_; }
  /// Number of projections whose friction is not in balance: the solver came to its limit of work first.
  std::int64_t unsettled_friction() const { return unsettled_friction_; }

 private:
  void set_forces(const CoupledProjection& projection);
  bool is_too_narrow(const CoupledProjection& projection) const;
  std::array<bool, kMaxParts> parts_without_room(const Displacements& towards);
  void solve_friction(const Displacements& towards, WorkBudget& budget);
  bool slipped(const CoupledRow& row) const;

  SimulatedParts& shared_;
  ContactRows& rows_;
  TurnedRows turned_rows_;
  std::vector<CouplingStiffness> grips_;  // infinite for a released part
  ProjectionSolver solver_;
  FrictionSolver friction_solver_;
  std::vector<double> coefficients_;  // of friction, one for each row
  std::int64_t unsettled_friction_ = 0;
  std::vector<CoupledRow> rows_of_group_;
  Displacements wanted_;
  Displacements projected_;
  std::vector<RowForce> forces_;
};

}  // namespace glissade::contact
