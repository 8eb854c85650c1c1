#pragma once

/// Random parts close to obstacles and to each other, and their near triangles by plain loops.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "certificate/pairs_to_certify.h"
#include "random_numbers.h"
#include "scene/contact_scene.h"

namespace glissade::test_support {

/// The distance in metres of two triangles with area, at the poses of their bodies.
double distance_of(std::span<const contact::PlacedBody> bodies, const contact::TrianglesOfBodies& pair);

/// All pairs of triangles within `radius` (metres) and their distances, at the poses of the bodies. The parts are the
/// bodies from `first_part` on.
std::map<contact::TrianglesOfBodies, double> near_triangles(std::span<const contact::PlacedBody> bodies,
                                                            std::size_t first_part, double radius);

/// Whether two triangles can stop each other with the edges and vertices that they own.
bool can_make_contact(const contact::ContactScene& scene, const contact::TrianglesOfBodies& pair);

/// All pairs of triangles in a pair to certify.
std::vector<contact::TrianglesOfBodies> triangles_of(std::span<const contact::PlacedBody> bodies,
                                                     const contact::PairToCertify& pair_to_certify);

/// A part or obstacle of about the size `size` (metres): a `random_mesh`, a fine plate, or a torus.
std::shared_ptr<const contact::SlidingPart> random_part(double size, RandomNumbers& random);

/// One or two obstacles and one or two parts of about the size `size` (metres), all with the same margin. No two of
/// them are nearer than `gap` (metres), and mostly one pair is hardly farther apart.
std::unique_ptr<contact::ContactScene> random_contact_scene(double size, double margin, double gap,
                                                            RandomNumbers& random);

}  // namespace glissade::test_support
