#pragma once

/// The step of one cycle: the wanted displacements projected on the contact rows, limited to the reach and the slew,
/// and certified free of collisions. Finding it may take several calls of the simulation.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>

#include "certificate/path_certificate.h"
#include "cycle/contact_rows.h"
#include "cycle/simulated_parts.h"
#include "cycle/turned_rows.h"
#include "solver/friction.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// Not thread-safe.
class StepFinder {
 public:
  /// `shared` must outlive this object.
  explicit StepFinder(SimulatedParts& shared);

  /// From then on, the contacts within `reach` (metres) constrain the steps. Those within `reach_ahead` may be asked
  /// for later.
  void look(double reach, double reach_ahead, WorkBudget& budget);

  /// A certified step that gains no energy, towards the poses at which the parts aim; a step of zero if there is none.
  /// Nothing if the budget was used up before: then the next call goes on, for which parts and candidates must be as
  /// they are now.
  std::optional<Step> find(WorkBudget& budget);
  /// Finds the forces of the contacts where the parts are now, without a step. `look` must have been called there.
  /// Returns the motion bounds (metres) of the displacements that another step would aim at.
  std::array<double, kMaxParts> find_forces(WorkBudget& budget);
  /// Whether `find` has to go on.
  bool is_under_way() const { return stage_ != Stage::kDone; }
  /// Gives the step up on which `find` had to go on.
  void give_up() { stage_ = Stage::kDone; }

  ContactRows& rows() { return rows_; }
  std::span<const RowForce> forces() const { return forces_; }
  /// Number of projections whose friction is not in balance: the solver came to its limit of work first.
  std::int64_t unsettled_friction() const { return unsettled_friction_; }
  /// Smallest distance (metres) of two bodies at their present poses that is certain in spite of rounding.
  double certain_distance() const { return certificate_.certain_distance(); }

 private:
  /// Where the step comes from that waits for its certificate.
  enum class Stage { kProjecting, kHalving, kDone };

  void begin(WorkBudget& budget);
  void aim();
  void begin_trial(WorkBudget& budget);
  void try_projection(WorkBudget& budget);
  void conclude(bool is_certified, WorkBudget& budget);
  void try_half(WorkBudget& budget);
  void end_trial(WorkBudget& budget);
  void note_arrivals();
  bool gains_energy();
  bool project(const Displacements& wanted, WorkBudget& budget);
  bool is_worth_another(const Displacements& displacements) const;
  bool project_again();
  void set_forces(const CoupledProjection& projection);
  Displacements shorten();
  bool is_too_narrow(const CoupledProjection& projection) const;
  std::array<bool, kMaxParts> parts_without_room(const Displacements& wanted);
  void solve_friction(const Displacements& wanted, WorkBudget& budget);
  bool slipped(const CoupledRow& row) const;
  void keep_covered(Displacements& displacements);
  void begin_certificate(const Displacements& displacements, WorkBudget& budget);
  std::array<bool, kMaxParts> parts_that_fail() const;

  SimulatedParts& shared_;
  ContactRows rows_;
  TurnedRows turned_rows_;
  PathCertificate certificate_;
  double reach_ = 0.0;  // metres

  std::vector<CouplingStiffness> grips_;  // infinite for a released part
  ProjectionSolver solver_;
  FrictionSolver friction_solver_;
  std::vector<double> coefficients_;  // of friction, one for each row
  std::int64_t unsettled_friction_ = 0;
  std::vector<CoupledRow> rows_of_group_;
  Displacements projected_;
  std::vector<RowForce> forces_;
  std::vector<RowForce> first_forces_;     // of the projection on contacts alone
  std::vector<PairToCertify> to_certify_;  // pairs that the step at hand may reach
  double damping_ = 0.0;                   // Levenberg–Marquardt

  Stage stage_ = Stage::kDone;
  int trial_ = 0;  // number of dampings so far
  int projections_ = 0;
  int halvings_ = 0;
  double most_energy_ = 0.0;
  Displacements wanted_;
  Displacements damped_;
  Step step_;                    // its certificate is under way
  Step first_;                   // on the contacts alone
  bool is_first_order_ = false;  // the second projection that it needs has no solution
  bool is_covered_ = false;      // by the candidates: otherwise no certificate is possible
};

}  // namespace glissade::contact
