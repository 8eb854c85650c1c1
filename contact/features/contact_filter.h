#pragma once

/// Which features of candidate pairs may be in contact: a fast look at many pairs before the exact one at few.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "features/feature_kernel.h"
#include "scene/contact_scene.h"
#include "search/candidate_search.h"

namespace glissade::contact {

/// Not thread-safe.
class ContactFilter {
 public:
  static constexpr std::size_t kMostPairs = 256;

  /// Contacts have gaps up to `reach`, may miss the end of an edge by `past_end`, and are nearest among neighboring
  /// features within `margin` (metres). The bodies must stay where they are.
  ContactFilter(std::span<const PlacedBody> bodies, double reach, double past_end, double margin)
      : bodies_(bodies), reach_(reach), past_end_(past_end), margin_(margin) {}

  /// Looks at up to kMostPairs pairs, which replace those of the last call, and of which `known` tells what is known,
  /// or is empty.
  void look(std::span<const TrianglesOfBodies> pairs, std::span<const KnownFeatures> known);
  /// The features of a pair that its triangles own and that may be in contact.
  FeaturePairs features(std::size_t pair) const { return features_[pair]; }
  /// Those of them that may be nearest where the bodies are now.
  FeaturePairs nearest(std::size_t pair) const { return nearest_[pair]; }
  /// Whether the vector code looked at the pair: without it, nothing is left out.
  bool was_looked_at(std::size_t pair) const { return was_looked_at_[pair]; }
  /// Metres: a certain lower bound of the gaps of all contacts that the pair can have, however far its bodies are; not
  /// positive if nothing is known. Where the bodies come nearer, it decreases by as much at most.
  double gap(std::size_t pair) const { return gaps_[pair]; }
  /// The same of those contacts that were left out because they are beyond reach; infinite if nothing was left out.
  double gap_beyond(std::size_t pair) const { return gaps_beyond_[pair]; }
  /// The same of all that were left out; 0 if the vector code did not look at the pair now.
  double gap_left_out(std::size_t pair) const { return gaps_left_out_[pair]; }

 private:
  /// Pairs of two bodies that wait until there are enough of them.
  struct Batch {
    BodyPair bodies;
    RelativePose X_OV;
    double coordinates;  ///< metres: bound of all coordinates in O
    std::size_t count = 0;
    std::array<std::size_t, kTrianglePairs> numbers;  ///< of the pairs
    TrianglePairs pairs;
    PossibleContacts possible;
  };

  Batch& batch_of(const BodyPair& bodies);
  void add(Batch& batch, const TrianglesOfBodies& pair, std::size_t number);
  void complete(Batch& batch);

  std::span<const PlacedBody> bodies_;
  double reach_;
  double past_end_;
  double margin_;
  std::vector<Batch> batches_;  // one for each pair of bodies so far
  std::size_t last_ = 0;        // the batch of the last pair
  std::array<FeaturePairs, kMostPairs> features_;
  std::array<FeaturePairs, kMostPairs> nearest_;
  std::array<bool, kMostPairs> was_looked_at_;
  std::array<double, kMostPairs> gaps_;
  std::array<double, kMostPairs> gaps_beyond_;
  std::array<double, kMostPairs> gaps_left_out_;
};

}  // namespace glissade::contact
