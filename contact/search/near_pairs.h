#pragma once

/// The search for what is near: one traversal of the trees of two bodies finds the pairs of triangles that may yield
/// contacts, and the pairs of boxes and triangles that a step must be certified against.

#include <cstddef>
#include <exception>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <glissade/collision/query_types.h>

#include "certificate/pairs_to_certify.h"
#include "scene/contact_scene.h"

namespace glissade::contact {

/// Two triangles within the radius of a search, or a little farther apart.
struct NearPair : TrianglesOfBodies {
  Eigen::Vector3d n_W;   ///< unit, from the obstacle to the part; zero where triangles touched
  double distance;       ///< metres, of single precision: their separation along n_W at the poses of the search
  bool turns_with_part;  ///< n_W is the normal of the part's triangle
  /// At least one of them owns an edge or vertex that can stop the other (`geometry::MeshTopology`).
  bool may_yield_contact;
  bool is_to_certify;  ///< it lies in no pair of boxes that is to be certified
};

PairToCertify to_certify(const NearPair& pair);

/// What a search is for: this decides which pairs of boxes it finds, and which pairs of triangles it measures. Those
/// that are not measured have the best direction of a few, and no distance but along it.
enum class SoughtPairs {
  /// Distances that nothing improves later: all pairs of boxes, and all pairs of triangles measured.
  kWithDistances,
  /// Planes that will be turned: only pairs of triangles are measured that no direction of the few separates by half a
  /// margin or so. Boxes whose triangles all may yield contacts are left out: their pairs are found in any case.
  kWithPlanes,
  /// The same where curved parts fit closely: the planes of boxes fail there within a few steps, those of triangles
  /// last longer. Boxes are left out as soon as both have triangles that may yield contacts.
  kWithPlanesInCloseFit
};

/// How far a search looks, and what it finds there.
struct SearchRange {
  double radius = 0.0;  ///< metres
  SoughtPairs sought = SoughtPairs::kWithPlanes;
  std::size_t most_pairs = std::numeric_limits<std::size_t>::max();  ///< of boxes and triangles; it ends with more
};

/// Ends a search that finds more pairs than it may.
struct TooManyPairs : std::exception {};

/// Appends the pairs of two bodies within the radius of each other: the pairs of boxes that a plane separates, with
/// distances of single precision, the pairs of triangles that lie in no such boxes, and of the others those that may
/// yield contacts. So each pair of triangles within the radius lies in one pair to certify. `margin` (metres) as in
/// `ContactScene::margin`. Only those pairs of boxes count that are sought; of the others, the triangles do. The
/// `meter` receives the work of taking over each pair before it is done; null: nobody does. Throws `TooManyPairs`
/// instead of making the lists longer than the range allows.
void find_near_pairs(const BodyPair& bodies, const PlacedBody& obstacle, const PlacedBody& part, double margin,
                     const SearchRange& range, collision::QueryWorkspace& workspace, collision::WorkMeter* meter,
                     std::vector<NearPair>& pairs, std::vector<PairToCertify>& boxes);

}  // namespace glissade::contact
