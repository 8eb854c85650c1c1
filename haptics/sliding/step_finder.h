#pragma once

/// The step of one cycle: the wanted displacements projected on the contact rows, limited to the reach and the slew,
/// and certified free of collisions.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glissade/haptics/coupling.h>

#include "certificate/path_certificate.h"
#include "sliding/contact_rows.h"
#include "sliding/simulated_parts.h"
#include "solver/friction.h"
#include "solver/projection.h"

namespace glissade::haptics {

/// Not thread-safe.
class StepFinder {
 public:
  /// `shared` must outlive this object.
  explicit StepFinder(SimulatedParts& shared);

  /// Finds the contacts within `reach` (metres), whose rows constrain the steps from then on.
  void look(double reach);

  /// A certified step that gains no energy, towards the poses at which the parts aim; a step of zero if there is none.
  Step find();

  ContactRows& rows() { return rows_; }
  std::span<const RowForce> forces() const { return forces_; }
  /// Smallest distance (metres) of two bodies at their present poses that is certain in spite of rounding.
  double certain_distance() const { return certificate_.certain_distance(); }

 private:
  Step certified(const Displacements& wanted);
  bool project(const Displacements& wanted);
  void solve_friction(const Displacements& wanted);
  bool slipped(const CoupledRow& row) const;
  bool halve_until_certified(Step& step);
  bool certify(const Displacements& displacements, Step& step);
  std::array<bool, kMaxParts> parts_that_fail() const;

  SimulatedParts& shared_;
  ContactRows rows_;
  PathCertificate certificate_;
  double reach_ = 0.0;  // metres

  std::vector<CouplingStiffness> grips_;  // infinite for a released part
  ProjectionSolver solver_;
  FrictionSolver friction_solver_;
  std::vector<double> coefficients_;  // of friction, one for each row
  Displacements projected_;
  std::vector<RowForce> forces_;
  std::vector<RowForce> first_forces_;     // of the projection on contacts alone
  std::vector<PairToCertify> to_certify_;  // pairs that the step at hand may reach
  std::vector<UncertifiedPair> failures_;
  double damping_ = 0.0;  // Levenberg–Marquardt
};

}  // namespace glissade::haptics
