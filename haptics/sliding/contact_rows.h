#pragma once

/// The constraint rows of a step: one for each contact within reach, and more for pairs that could not be certified.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "certificate/path_certificate.h"
#include "contact/contact_search.h"
#include "search/candidate_pairs.h"
#include "sliding/simulated_parts.h"
#include "solver/friction.h"
#include "solver/projection.h"
#include "work/work_budget.h"

namespace glissade::haptics {

/// Not thread-safe.
class ContactRows {
 public:
  /// `shared` must outlive this object.
  explicit ContactRows(SimulatedParts& shared) : shared_(shared) {}

  /// Finds the contacts within `reach` (metres) at the present poses, and one row for each. Replaces all contacts and
  /// rows.
  void find(double reach, WorkBudget& budget);
  /// Finds also those within `reach_ahead`, at the same poses. They get no row.
  void find_ahead(double reach_ahead, WorkBudget& budget);
  /// Drops the rows of failed certificates.
  void keep_contacts_only();
  /// Adds rows for failed certificates: each keeps the part's triangle on its side of the plane that separated the
  /// pair.
  void add_failures(std::span<const UncertifiedPair> failures);
  /// Demands no margin back, so that standing still is allowed.
  void allow_standing_still();

  std::span<const CoupledRow> rows() const { return rows_; }
  /// The contacts with rows and, after them, those ahead. From then on, until the next call of `find`, no function may
  /// be called that uses contacts.
  std::vector<Contact>& all_contacts();

  /// Notes the forces of the step that is taken at the contacts. A row of a failed certificate that pushes becomes a
  /// contact too.
  void take_forces(std::span<const RowForce> forces);
  /// Appends the forces of the last step, by row, where the same features still touch: the starting point of the
  /// friction solver.
  void recall_forces(std::vector<RowForce>& forces) const;
  /// Forgets the forces of the last step.
  void forget_forces() { pushed_.clear(); }

 private:
  void leave_out_complete(double reach_ahead);
  void find_among_pairs(double reach, std::vector<Contact>& contacts, WorkBudget& budget);
  void add(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W, const Eigen::Vector3d& p_W,
           double bound);

  SimulatedParts& shared_;
  double reach_ = 0.0;
  std::vector<CandidatePair> pairs_;       // that may have contacts within reach
  std::vector<std::uint32_t> numbers_;     // of them among the candidates
  std::vector<KnownFeatures> known_;       // of them
  std::vector<GapsOfPair> gaps_;           // of them
  std::vector<double> gaps_beyond_;        // metres, by candidate: of contacts beyond the reach; 0: not known
  std::vector<Contact> contacts_;          // one for each of the first rows
  std::vector<Contact> contacts_ahead_;    // beyond the reach
  std::vector<CoupledRow> rows_;           // of contacts, then of failed certificates
  std::vector<Contact> failure_contacts_;  // one for each row of a failed certificate
  std::vector<Contact> pushed_;            // the contacts that pushed in the last step; with friction only
};

}  // namespace glissade::haptics
