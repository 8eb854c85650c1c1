#pragma once

/// The constraint rows of a step: one for each contact within reach, and more for pairs that could not be certified.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/projection.h>

#include "certificate/path_certificate.h"
#include "cycle/pairs_in_reach.h"
#include "cycle/simulated_parts.h"
#include "features/contact_search.h"
#include "search/candidate_pairs.h"
#include "solver/friction.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// Not thread-safe.
class ContactRows {
 public:
  /// `shared` must outlive this object.
  explicit ContactRows(SimulatedParts& shared) : shared_(shared), pairs_(shared) {}

  /// Looks for contacts within `reach` (metres) at the present poses, or within `reach_ahead` later, and finds the
  /// nearest, with a row for each of those within `reach`. Replaces all contacts and rows, unless those that it has are
  /// of the same poses and candidates and reach as far.
  void find(double reach, double reach_ahead, WorkBudget& budget);
  /// Finds contacts within `reach` that displacements of the parts would bring nearer than their margin, and their
  /// rows. Returns false if there is no such row: those that are still missing are not needed.
  bool find_violated(const Displacements& displacements, WorkBudget& budget);
  /// Finds more of the nearest contacts within `reach_ahead`, at the same poses. They get no row. Returns the distance
  /// (metres) within which all contacts have been found.
  double find_ahead(WorkBudget& budget);
  /// The distance (metres) within which all contacts have a row.
  double complete() const { return complete_; }
  /// Whether there may be anything within `reach`.
  bool is_anything_near() const { return !contacts_.empty() || pairs_.left_count() > 0; }
  /// Drops the rows of failed certificates.
  void keep_contacts_only();
  /// Adds rows for failed certificates: each keeps the part's triangle on its side of the plane that separated the
  /// pair.
  void add_failures(std::span<const UncertifiedPair> failures);
  /// For places that are too narrow for the margins: the contacts of these parts demand nothing back, and may close to
  /// little more than their minimum clearance. Standing still is allowed then. Holds until `find`; after it, margins
  /// are demanded back only as a whole (`margins_fit`), or parts would go to and fro between what is too narrow for the
  /// margins and what is wide enough for a part of them.
  void use_room(const std::array<bool, kMaxParts>& parts);
  /// There is a place where the contacts of all parts have what they demand.
  void margins_fit();

  std::span<const CoupledRow> rows() const { return rows_; }
  /// The contacts with rows, one for each.
  std::span<const Contact> contacts() const { return contacts_; }
  /// The contacts with rows and, after them, those ahead; to be taken away. Rows of failed certificates are dropped
  /// unless they push.
  std::vector<Contact>& all_contacts();

  /// Notes the forces of the step that is taken at the contacts. A row of a failed certificate that pushes becomes a
  /// contact too.
  void take_forces(std::span<const RowForce> forces);

 private:
  /// On what contacts and rows depend, besides their reach.
  struct Situation {
    std::vector<Eigen::Isometry3d> X_WB;  ///< of the movers
    std::vector<Eigen::Vector3d> p_Vref;  ///< of the parts
    std::vector<char> is_held;            ///< the same
    std::int64_t searches = -1;           ///< for candidates, so far

    bool operator==(const Situation& other) const;
  };

  void note_situation();
  void find_contacts_of_taken(WorkBudget& budget);
  void find_contacts_of(std::span<const TrianglesOfBodies> pairs, std::span<const PlaceOfPair> places, double reach,
                        WorkBudget& budget);
  void find_beyond(WorkBudget& budget);
  void keep_contacts(const std::function<bool(std::size_t row)>& is_kept);
  void add_rows_of_ahead();
  double least_gap(const Contact& contact) const;
  bool belongs_to(const CoupledRow& row, const std::array<bool, kMaxParts>& parts) const;
  void give_up_margin(std::size_t row);
  void add(const Contact& contact);
  void add(const Contact& contact, double bound, bool is_of_failure = false);

  /// A pair that was looked at.
  struct LookedAt {
    PlaceOfPair pair;
    double beyond;  // metres: no contact beyond the reach has a smaller gap
  };

  SimulatedParts& shared_;
  double reach_ = 0.0;        // metres
  double reach_ahead_ = 0.0;  // metres
  double complete_ = 0.0;     // metres
  bool may_be_kept_ = false;  // contacts and rows are as they were found
  Situation situation_;
  Situation found_in_;  // contacts and rows
  PairsInReach pairs_;
  std::vector<LookedAt> looked_at_;
  std::vector<TrianglesOfBodies> candidates_;  // that a search for contacts is about
  std::vector<PlaceOfPair> places_;
  std::vector<KnownFeatures> known_;
  std::vector<GapsOfPair> gaps_;
  std::vector<Contact> found_;           // of the last search for contacts
  std::vector<Contact> contacts_;        // one for each row
  std::vector<bool> is_of_failure_;      // of each row: it comes from a failed certificate
  std::vector<Contact> contacts_ahead_;  // without a row
  std::vector<Contact> all_contacts_;
  std::vector<CoupledRow> rows_;
  std::array<bool, kMaxParts> uses_room_{};   // since the last `find`
  std::array<bool, kMaxParts> lacks_room_{};  // at the last places for which it was tried
};

}  // namespace glissade::contact
