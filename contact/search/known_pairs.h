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

namespace glissade::contact {

/// A candidate pair by its number, with the place of its plane: among those of its bodies, which have a place among
/// all.
struct PlaceOfPair {
  std::uint32_t number;
  std::uint32_t planes;
  std::uint32_t slot;
};

/// What is known of the pairs of two bodies, by the slots of their planes.
struct GapsBySlot {
  std::vector<float> gaps;  ///< metres: no contact of the pair has a smaller one; infinite if it has none
  std::vector<float>
      of_blocks;  ///< the least of each block, or a lower bound; where it is infinite, `gaps` are not set
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
  void within(double reach, std::vector<TrianglesOfBodies>& pairs) const;
  /// The same for the pairs to certify, which hold all triangles, with features or without, in the largest boxes that
  /// separate. Boxes come before triangles.
  void within(double reach, std::vector<PairToCertify>& pairs) const;

  /// The same for the step that `certificate` is about, without the pairs that a known plane keeps apart on the whole
  /// path: only those within `reach` are certain to be there. Spends the work of looking at the planes.
  void unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                       WorkBudget& budget);
  /// Takes over the directions that `certificate` found for these pairs.
  void note_planes(std::span<const SeparatedPair> separated);

  /// Sets the gaps of those candidates that may have contacts within `reach` (metres), as far as their planes and
  /// `note_gaps` tell, and of others; an entry for each of `planes`. Returns the number of those within reach.
  std::size_t find_gaps(double reach, std::vector<GapsBySlot>& gaps);
  TrianglesOfBodies triangles(const PlaceOfPair& pair) const {
    return search_.set.planes[pair.planes].triangles(pair.slot);
  }
  /// What is known of the features of a pair within `reach` (metres).
  KnownFeatures known_features(std::uint32_t number, double reach) const;
  /// The planes of the pairs of triangles, which may be turned.
  std::vector<PlanesOfBodies>& planes() { return search_.set.planes; }
  /// Notes for the pairs at these places that their contacts have at least these gaps (metres).
  void note_gaps(std::span<const PlaceOfPair> pairs, std::span<const GapsOfPair> gaps);

  /// Number of pairs of triangles.
  std::size_t pair_count() const { return search_.set.pairs.size(); }
  /// Number of pairs that may yield contacts, plus that of pairs to certify.
  std::size_t size() const { return search_.set.contact_count + search_.set.certify_count; }

 private:
  /// For the pairs of two bodies with planes: gaps, metres, minus the clock as below.
  struct OfBodies {
    // By slot: of contacts; infinite where the pair has none.
    std::vector<float> contacts;
    // By slot: infinite where the pair is not to be certified, minus infinity where it is.
    std::vector<float> to_certify;
    // The least of each block.
    std::vector<double> blocks_of_contacts;
    std::vector<double> blocks_to_certify;
  };

  void take_pairs_of(const PlanesOfBodies& planes, OfBodies& known) const;
  void add_unproved(const PathOfBodies& path, std::uint32_t planes, std::vector<PairToCertify>& unproved,
                    WorkBudget& budget);

  const ContactScene& scene_;
  TrackedSearch search_;
  // Since the answer was taken, two bodies have come nearer by at most `clock_` (metres).
  double clock_ = 0.0;
  std::vector<OfBodies> of_bodies_;
  std::vector<KnownFeatures> known_;              // by number; their gaps are so, too, minus the clock
  std::vector<Eigen::Isometry3d> X_WB_of_clock_;  // of each mover
  std::vector<BoundedMotion> motions_of_clock_;
  std::vector<PlaceOfPair> places_;  // of the pairs in the list of the last call of `unproved_within`
  std::vector<float> gaps_at_begin_;
  std::vector<float> gaps_at_end_;
  std::vector<float> least_gaps_;  // of blocks
};

}  // namespace glissade::contact
