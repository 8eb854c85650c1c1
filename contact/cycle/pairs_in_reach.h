#pragma once

/// The candidate pairs that a step may bring into contact, taken as they are needed: the nearest first, then those that
/// a step would bring too near. The planes of the others prove that they are not needed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "certificate/lasting_separation.h"
#include "cycle/simulated_parts.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {

/// Not thread-safe.
class PairsInReach {
 public:
  /// `shared` must outlive this object.
  explicit PairsInReach(SimulatedParts& shared) : shared_(shared) {}

  /// Begins anew: of all pairs that may be within `reach` (metres) at the present poses, none has been taken.
  void look(double reach);

  /// Takes all pairs within `reach` that may be nearer than `gap` (metres), and more, up to `count` in all, the nearest
  /// first. Returns the distance (metres) within which all pairs have been taken then.
  double take_nearest(double gap, std::size_t count, double reach);
  /// Finds the pairs within `reach` whose planes do not prove that displacements of the parts, to first order, leave
  /// them a margin apart.
  void find_too_near(const Displacements& displacements, double reach);
  /// Takes up to `most` of these, those first that come nearest; in the next call the next ones. Where a pair has
  /// another plane that keeps it apart, it gets this one instead.
  void take_too_near(std::size_t most);

  /// Those that the last call took, in the order of the candidates: their triangles and their places.
  std::span<const TrianglesOfBodies> taken() const { return pairs_; }
  std::span<const PlaceOfPair> places() const { return places_; }
  /// Number of pairs that have not been taken.
  std::size_t left_count() const { return left_count_; }

 private:
  /// Where the corners of the part of two bodies are, to first order, in the frame of the obstacle.
  struct Way {
    CornerMap begin;
    CornerMap end;
    PlaneMaps maps_at_end;
    double margin;
  };

  struct TooNear {
    float gap_at_end;  ///< metres
    PlaceOfPair pair;
  };

  template <typename Visit>
  void visit_blocks_within(double gap, const Visit& visit) const;
  template <typename Visit>
  void visit_within(double gap, const Visit& visit) const;
  std::size_t count_within(double gap) const;
  double distance_of_nearest(double gap, std::size_t count, double reach);
  float& gap_of(const PlaceOfPair& pair) { return left_[pair.planes].gaps[pair.slot]; }
  Way way_of(const PlanesOfBodies& planes, const Displacements& displacements) const;
  void add_separation(const PlaceOfPair& pair);
  void turn_plane(const PlaceOfPair& pair, const FixedDirection& direction);
  const ContactBody& body(std::int32_t number) const;
  void begin_taking();
  void take(const PlaceOfPair& pair);

  SimulatedParts& shared_;
  std::vector<GapsBySlot> left_;  // those of pairs that were taken are infinite
  std::size_t left_count_ = 0;
  std::vector<TrianglesOfBodies> pairs_;
  std::vector<PlaceOfPair> places_;
  std::vector<float> gaps_;
  // Of the pairs of bodies that have planes:
  std::vector<Way> ways_;
  LastingSeparations separations_;
  std::vector<float> gaps_at_end_;
  std::vector<TooNear> too_near_;
  std::size_t next_ = 0;  // of `too_near_`
};

}  // namespace glissade::contact
