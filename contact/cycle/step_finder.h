#pragma once

/// The step of one cycle: the wanted displacements projected on the contact rows, limited to the reach and the slew,
/// and certified free of collisions. Finding it may take several calls of the simulation.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "certificate/path_certificate.h"
#include "cycle/contact_rows.h"
#include "cycle/simulated_parts.h"
#include "cycle/step_projection.h"
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
  bool is_under_way() const { return is_under_way_; }
  /// Gives the step up on which `find` had to go on.
  void give_up() { is_under_way_ = false; }

  ContactRows& rows() { return rows_; }
  std::span<const RowForce> forces() const { return forces_; }
  /// As `StepProjection::unsettled_friction`.
  std::int64_t unsettled_friction() const { return projection_.unsettled_friction(); }
  /// Smallest distance (metres) of two bodies at their present poses that is certain in spite of rounding.
  double certain_distance() const { return certificate_.certain_distance(); }

 private:
  void begin(WorkBudget& budget);
  void begin_trial(WorkBudget& budget);
  void try_projection(WorkBudget& budget);
  void note_first();
  bool falls_back_to_first();
  void try_half(WorkBudget& budget);
  void end_trial(WorkBudget& budget);
  void note_arrivals();
  bool gains_energy();
  bool project(const Displacements& towards, WorkBudget& budget);
  Displacements shorten();
  void keep_covered(Displacements& displacements);
  void begin_certificate(const Displacements& displacements, WorkBudget& budget);
  std::array<bool, kMaxParts> parts_that_fail() const;

  SimulatedParts& shared_;
  ContactRows rows_;
  StepProjection projection_;
  PathCertificate certificate_;
  double reach_ = 0.0;  // metres

  std::vector<RowForce> forces_;
  std::vector<PairToCertify> to_certify_;  // pairs that the step at hand may reach
  double damping_ = 0.0;                   // Levenberg–Marquardt

  // The step that waits for its certificate, and how it came about: a call that ends early leaves all of it as it is.
  bool is_under_way_ = false;
  int trial_ = 0;        // number of dampings so far
  int projections_ = 0;  // of this trial
  int halvings_ = 0;     // of its last projection
  double most_energy_ = 0.0;
  Displacements damped_;
  Step step_;
  Step first_;                          // on the contacts alone
  std::vector<RowForce> first_forces_;  // of that one
  bool is_first_order_ = false;         // the second projection that it needs has no solution
  bool is_covered_ = false;             // by the candidates: otherwise no certificate is possible
};

}  // namespace glissade::contact
