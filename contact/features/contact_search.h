#pragma once

/// Contacts from candidate pairs: the pairs of features that can stop a part. The orientation of triangles is never
/// used.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding_result.h>

#include "search/candidate_pairs.h"

namespace glissade::contact {

/// Replaces `contacts` by one contact for every pair of features of the `bodies` within `reach` (metres):
/// - a vertex over the inside of a face, on either side; the normal is that of the face, towards the side on which the
///   vertex is now;
/// - two edges whose closest points lie inside both, and vertices against edges and vertices, if the pair is a local
///   minimum of distance over the neighboring features (within `margin`, metres), so that a seam never acts like a
///   wall.
///
/// Edges and vertices inside plane patches and vertices inside straight rims are left out, because other features bound
/// patch and rim. Each edge and vertex is considered only for the triangle that owns it, which is among the
/// candidates whenever the feature is within reach. `first_part` is the body number of the first part.
///
/// `gaps`, if not null, receives what is known then of the contacts of each candidate, as long as its bodies do not
/// come nearer. Where they do, these bounds decrease by as much. `known`, if not empty, is what is known before; it
/// must hold within `reach`.
void find_contacts(std::span<const PlacedBody> bodies, std::size_t first_part,
                   std::span<const TrianglesOfBodies> candidates, double reach, double margin,
                   std::vector<Contact>& contacts, std::vector<GapsOfPair>* gaps = nullptr,
                   std::span<const KnownFeatures> known = {});

}  // namespace glissade::contact
