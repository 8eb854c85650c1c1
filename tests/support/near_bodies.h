#pragma once

/// Random parts close to obstacles and to each other, and what is near in truth, by plain loops over triangles.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include <glissade/haptics/proof_front.h>
#include <glissade/haptics/surroundings.h>

#include "random_numbers.h"

namespace glissade::test_support {

/// Two triangles of two bodies, of which the second is a part and the first has a lower number.
struct BodyTriangles {
  haptics::BodyPair bodies;
  std::int32_t triangle_O;
  std::int32_t triangle_P;

  friend bool operator<(const BodyTriangles& a, const BodyTriangles& b) {
    return std::tie(a.bodies.obstacle, a.bodies.part, a.triangle_O, a.triangle_P) <
           std::tie(b.bodies.obstacle, b.bodies.part, b.triangle_O, b.triangle_P);
  }
};

/// The distance of two triangles with an area where the bodies are placed, metres.
double distance_of(std::span<const haptics::PlacedBody> bodies, const BodyTriangles& pair);

/// All pairs of triangles within `radius` (metres), and their distances, where the bodies are placed; the parts are the
/// bodies from `first_part` on.
std::map<BodyTriangles, double> near_triangles(std::span<const haptics::PlacedBody> bodies, std::size_t first_part,
                                               double radius);

/// All pairs of triangles that an obligation holds.
std::vector<BodyTriangles> triangles_of(std::span<const haptics::PlacedBody> bodies,
                                        const haptics::Obligation& obligation);

/// A part or obstacle of about this size (metres): what `random_mesh` makes, or a finely cut plate, or a torus.
std::shared_ptr<const haptics::SlidingPart> random_part(double size, RandomNumbers& random);

/// One or two obstacles and one or two parts of about this size, all with the same margin, that lie so that no two of
/// them are nearer than `gap` (metres), and mostly one pair is hardly further apart.
std::unique_ptr<haptics::Surroundings> random_surroundings(double size, double margin, double gap,
                                                           RandomNumbers& random);

}  // namespace glissade::test_support
