#pragma once

/// The pairs of a search, and what later cycles have found out about them: lower bounds of gaps, planes, features. So a
/// cycle looks only at pairs that may be in reach by now.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "certificate/path_certificate.h"
#include "certificate/separating_planes.h"
#include "scene/contact_scene.h"
#include "search/approach.h"
#include "search/candidate_search.h"
#include "search/tracked_search.h"
#include "work/work_budget.h"

namespace glissade::haptics {

/// A candidate pair by its number, with the place of its plane: among those of its bodies, which have a place among
/// all.
struct PairInReach {
  std::uint32_t number;
  std::uint32_t planes;
  std::uint32_t slot;
  float gap;  ///< metres: no contact of the pair has a smaller one
};

/// Distances and gaps are those at the present poses of the scene's movers, wherever these have been placed since the
/// last call of `moved`. Not thread-safe.
class KnownPairs {
 public:
  /// The scene must outlive this object.
  explicit KnownPairs(const ContactScene& scene) : scene_(scene) {}

  /// Takes the answer of a search, and leaves its memory to the next one. The movers are at X_WB.
  void take(TrackedSearch& next, std::span<const Eigen::Isometry3d> X_WB);
  /// To be called when the movers have been placed at X_WB.
  void moved(std::span<const Eigen::Isometry3d> X_WB);
  /// Nothing is known until the next answer.
  void forget() { search_.is_there = false; }

  /// The search that found the pairs.
  const TrackedSearch& search() const { return search_; }

  /// Replaces `pairs` by the candidates that may be within `reach` (metres), in ascending order of the distance at the
  /// poses of the search.
  void within(double reach, std::vector<NearPair>& pairs) const;
  /// The same for the pairs to certify, which hold all triangles, with features or without, in the largest boxes that
  /// separate. Boxes come before triangles.
  void within(double reach, std::vector<PairToCertify>& pairs) const;

  /// The same for the step that `certificate` is about, without the pairs that a known plane keeps apart on the whole
  /// path: only those within `reach` are certain to be there. Spends the work of looking at the planes.
  void unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                       WorkBudget& budget);
  /// Takes over the directions that `certificate` found for these pairs.
  void note_planes(std::span<const SeparatedPair> separated);

  /// Replaces `pairs` by those candidates that may have contacts within `reach` (metres), as far as their planes and
  /// `note_gaps` tell, in the same order.
  void in_reach(double reach, std::vector<PairInReach>& pairs);
  const NearPair& pair(std::uint32_t number) const { return search_.set.pairs[number]; }
  /// What is known of the features of a pair within `reach` (metres).
  KnownFeatures known_features(std::uint32_t number, double reach) const;
  /// The planes of the pairs of triangles, which may be turned.
  std::vector<PlanesOfBodies>& planes() { return search_.set.planes; }
  /// Notes for the pairs with these numbers that their contacts have at least these gaps (metres).
  void note_gaps(std::span<const std::uint32_t> numbers, std::span<const GapsOfPair> gaps);

  /// Number of pairs of triangles.
  std::size_t pair_count() const { return search_.set.pairs.size(); }
  /// Number of pairs that may yield contacts, plus that of pairs to certify.
  std::size_t size() const { return search_.set.contact_count + search_.set.certify_count; }

 private:
  /// A pair in the list of the last call of `unproved_within`.
  struct PlaceOfPair {
    PlanesOfBodies* planes;  // null: it has none
    std::size_t slot;
    std::uint32_t number;  // of the pair of triangles
  };
  /// For the planes of each two bodies: of each block, the least gap (metres), minus the clock as below.
  using GapsOfBlocks = std::vector<std::vector<double>>;

  GapsOfBlocks gaps_at_search() const;
  template <typename Visit>
  void visit_near_blocks(const std::vector<double>& gaps, double reach, const Visit& visit) const;

  const ContactScene& scene_;
  TrackedSearch search_;
  // Since the answer was taken, two bodies have come nearer by at most `clock_` (metres). No contact of a pair has a
  // gap below its entry of `gaps_` minus the clock.
  double clock_ = 0.0;
  std::vector<double> gaps_;
  std::vector<KnownFeatures> known_;              // the gaps are so, too, minus the clock
  std::vector<Eigen::Isometry3d> X_WB_of_clock_;  // of each mover
  std::vector<BoundedMotion> motions_of_clock_;
  std::vector<PlaceOfPair> places_;
  GapsOfBlocks gaps_of_contacts_;
  GapsOfBlocks gaps_to_certify_;
  std::vector<float> gaps_at_begin_;
  std::vector<float> gaps_at_end_;
};

}  // namespace glissade::haptics
