#pragma once

/// Queries of two trees of pqp/tree.h by the published method of PQP, compiled for the processor of the machine. X_AB
/// is the pose of mesh B in the frame of mesh A. None of them allocates.

#include <cstddef>
#include <cstdint>
#include <span>

#include "tree.h"

namespace glissade::bench::pqp {

/// Indices of triangles in their meshes or, where a query says so, in their trees.
struct TriangleIds {
  std::int32_t A;
  std::int32_t B;
};

/// Stops at the first pair of triangles that overlap.
bool intersects(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB);

/// Number of pairs of triangles that overlap. Writes their ids as far as there is room for them.
std::size_t intersecting_pairs(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, std::span<TriangleIds> pairs);

/// Distance without any error but that of rounding; 0 where the meshes intersect. The bound of the search begins with
/// the distance of two triangles, `nearest` (indices in the trees), and the search leaves the nearest two there for the
/// next query.
float distance(const Tree& tree_A, const Tree& tree_B, const Pose& X_AB, TriangleIds& nearest);

}  // namespace glissade::bench::pqp
