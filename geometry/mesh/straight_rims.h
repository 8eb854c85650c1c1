#pragma once

/// Vertices in the interior of straight rims: straight lines of edges that are not flat.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// The edges of one vertex that are not flat: their number, and the vertices at the other end of the first two.
struct RimEdges {
  int count = 0;
  std::array<std::int32_t, 2> to{};
};

/// For each vertex, 1 if it lies inside a straight rim, else 0; `rims` has one entry per vertex. A vertex lies inside
/// if exactly two of its edges are not flat, these two continue each other without a bend, and it lies within 0.1 µm of
/// the chord between the nearest vertices of the rim that do not lie inside. The chord is needed because the bends of a
/// fine curve add up: a vertex and its neighbors alone do not show them. Cost O(n log n).
std::vector<char> inside_straight_rims(const TriangleMesh& mesh, std::span<const RimEdges> rims);

}  // namespace glissade::geometry
