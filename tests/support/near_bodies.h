#pragma once

/// Random parts close to obstacles and to each other, and what is near in truth, by plain loops over triangles.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "certificate/pairs_to_certify.h"
#include "scene/contact_scene.h"
#include "random_numbers.h"

namespace glissade::test_support {

/// The distance of two triangles with an area where the bodies are placed, metres.
double distance_of(std::span<const haptics::PlacedBody> bodies, const haptics::TrianglesOfBodies& pair);

/// All pairs of triangles within `radius` (metres), and their distances, where the bodies are placed; the parts are the
/// bodies from `first_part` on.
std::map<haptics::TrianglesOfBodies, double> near_triangles(std::span<const haptics::PlacedBody> bodies,
                                                            std::size_t first_part, double radius);

/// All pairs of triangles that an pair_to_certify holds.
std::vector<haptics::TrianglesOfBodies> triangles_of(std::span<const haptics::PlacedBody> bodies,
                                                     const haptics::PairToCertify& pair_to_certify);

/// A part or obstacle of about this size (metres): what `random_mesh` makes, or a finely cut plate, or a torus.
std::shared_ptr<const haptics::SlidingPart> random_part(double size, RandomNumbers& random);

/// One or two obstacles and one or two parts of about this size, all with the same margin, that lie so that no two of
/// them are nearer than `gap` (metres), and mostly one pair is hardly further apart.
std::unique_ptr<haptics::ContactScene> random_surroundings(double size, double margin, double gap,
                                                           RandomNumbers& random);

}  // namespace glissade::test_support
