#pragma once

/// The constraint rows of a step: one for each contact within reach, and more for pairs that could not be certified.

#include <cstddef>
#include <span>
#include <vector>

#include "certificate/path_certificate.h"
#include "search/candidate_pairs.h"
#include "sliding/simulated_parts.h"
#include "solver/friction.h"
#include "solver/projection.h"

namespace glissade::haptics {

/// Not thread-safe.
class ContactRows {
 public:
  /// `shared` must outlive this object.
  explicit ContactRows(SimulatedParts& shared) : shared_(shared) {}

  /// Replaces the contacts by those within `reach` (metres) of where the parts are, and the rows by theirs.
  void find(double reach);
  /// Drops the rows of failed certificates.
  void keep_contacts_only();
  /// Keeps each triangle that could not be certified on its side of the plane that separated it.
  void add_failures(std::span<const UncertifiedPair> failures);
  /// Asks for no margin back: standing still is always allowed then.
  void allow_standing_still();

  std::span<const CoupledRow> rows() const { return rows_; }
  std::vector<Contact>& contacts() { return contacts_; }

  /// Notes the forces of the step that is taken at the contacts; a row of a failed certificate becomes a contact too.
  void take_forces(std::span<const RowForce> forces);
  /// The forces of the last step where the same features still touch, by row: the start of a friction solution.
  void recall_forces(std::vector<RowForce>& forces) const;
  /// Forgets the forces of the last step.
  void forget_forces() { pushed_.clear(); }

 private:
  void add(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W, const Eigen::Vector3d& p_W,
           double bound);

  SimulatedParts& shared_;
  std::vector<CandidatePair> pairs_;     // within reach
  std::vector<Contact> contacts_;        // one for each of the first rows
  std::vector<CoupledRow> rows_;         // of contacts, then of failed certificates
  std::vector<Contact> proof_contacts_;  // one for each of the latter
  std::vector<Contact> pushed_;          // in the last step, where there is friction
};

}  // namespace glissade::haptics
