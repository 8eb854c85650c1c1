#pragma once

/// From candidate pairs to contacts: which pairs of features can stop the part, found without any use of orientation.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/sliding_result.h>

#include "search/candidate_pairs.h"

namespace glissade::haptics {

/// Replaces `contacts` by one contact for every pair of features of the `bodies` within `reach` (metres):
/// - a vertex over the inside of a face, of either side; its normal is the face's, on the side where the vertex is now;
/// - two edges whose closest points lie inside both, and vertices against edges and vertices, where the pair is a local
///   minimum of distance over the neighboring features (within `margin`), so that a seam never acts like a wall.
/// Edges and vertices inside plane patches and vertices inside straight rims are left out: others bound these. Each
/// edge and vertex is considered for one of its triangles only, which is among the candidates whenever the feature is
/// within reach. `first_part` is the number of the first body that is a part.
void find_contacts(std::span<const PlacedBody> bodies, std::size_t first_part,
                   std::span<const CandidatePair> candidates, double reach, double margin,
                   std::vector<Contact>& contacts);

}  // namespace glissade::haptics
