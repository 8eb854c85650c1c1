#pragma once

/// The vector code in front of the contact search: which features of two triangles may be in contact. Single precision,
/// with slack for its rounding: what it leaves out is certainly no contact.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "search/feature_pairs.h"

namespace glissade::contact {

// Five bits for each number i of a corner or edge, in the order in which contacts are searched for.
inline constexpr int kBitsOfFeature = 5;
inline constexpr int kPartCorner = 0;
inline constexpr int kObstacleCorner = 1;
inline constexpr int kFirstEdges = 2;

/// Corner i of the part's triangle with the obstacle's triangle.
constexpr FeaturePairs with_part_corner(int i) {
  return 1U << (kBitsOfFeature * i + kPartCorner);
}
/// Corner i of the obstacle's triangle with the part's triangle.
constexpr FeaturePairs with_obstacle_corner(int i) {
  return 1U << (kBitsOfFeature * i + kObstacleCorner);
}
/// Edge i of the part's triangle with edge j of the obstacle's.
constexpr FeaturePairs with_edges(int i, int j) {
  return 1U << (kBitsOfFeature * i + kFirstEdges + j);
}
inline constexpr FeaturePairs kAllCorners = with_part_corner(0) | with_part_corner(1) | with_part_corner(2) |
                                            with_obstacle_corner(0) | with_obstacle_corner(1) | with_obstacle_corner(2);
inline constexpr FeaturePairs kAllFeaturePairs = 0x7fff;

/// Calls `visit` with i and what is with it for each of these pairs: kPartCorner, kObstacleCorner, or kFirstEdges + j.
/// Few are set in most cases, and it would be hard to predict which.
template <typename Visit>
void for_each_feature_pair(FeaturePairs features, const Visit& visit) {
  for (; features != 0; features &= features - 1) {
    const int bit = std::countr_zero(features);
    visit(bit / kBitsOfFeature, bit % kBitsOfFeature);
  }
}

inline constexpr std::size_t kTrianglePairs = 16;

/// The corners of up to sixteen pairs of triangles of two bodies.
struct alignas(64) TrianglePairs {
  using Corners = std::array<std::array<std::array<double, kTrianglePairs>, 3>, 3>;  // [corner][axis][pair]
  Corners p_O;  ///< of the obstacle, in its frame O, metres
  Corners p_V;  ///< of the part, in its frame V, metres
};

/// The pose of V in O.
struct RelativePose {
  std::array<std::array<double, 3>, 3> R_OV;  // [row][column]
  std::array<double, 3> p_OV;                 ///< metres
};

/// What makes a contact, metres.
struct ContactReach {
  double reach;        ///< the largest gap
  double past_end;     ///< the length by which the ends of edges may be missed
  double margin;       ///< by which corners of the triangles of two edges may be nearer than these, along their normal
  double coordinates;  ///< bound of all coordinates in O: nothing is left out of triangles as small as its rounding
};

/// Features of the pairs of triangles.
struct alignas(64) PossibleContacts {
  /// Features that count; then those of them that may be in contact: within reach and, for two edges, with the closest
  /// points of their lines inside both.
  std::array<FeaturePairs, kTrianglePairs> features;
  /// Those of them that may be so at the present poses: without edges of which another corner of a triangle is nearer.
  std::array<FeaturePairs, kTrianglePairs> nearest;
  /// Metres, not negative: a certain lower bound of the distances of all features that counted.
  std::array<float, kTrianglePairs> gaps;
  /// The same of those features that were left out because they are beyond reach, and of all that were left out.
  std::array<float, kTrianglePairs> gaps_beyond;
  std::array<float, kTrianglePairs> gaps_left_out;
};

/// Leaves out features that are certainly not in contact, and sets the gaps.
void leave_out_impossible(const TrianglePairs& pairs, const RelativePose& X_OV, const ContactReach& reach,
                          PossibleContacts& possible);

}  // namespace glissade::contact
