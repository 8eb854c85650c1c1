#pragma once

/// Which vertices of a mesh lie inside straight lines of edges.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// For each vertex, the number of its edges that are not flat, and where the first two of them lead.
struct RimEdges {
  int count = 0;
  std::array<std::int32_t, 2> to{};
};

/// For each vertex, whether exactly two edges that are not flat meet there and go on in one line: without a bend, and
/// within 0.1 µm of the chord between the nearest vertices of that line of which this is not so. Bends of a fine curve
/// add up, so one vertex and its neighbors do not tell. Cost O(n log n).
std::vector<char> inside_straight_rims(const TriangleMesh& mesh, std::span<const RimEdges> rims);

}  // namespace glissade::geometry
