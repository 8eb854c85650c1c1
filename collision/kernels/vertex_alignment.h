#pragma once

/// Realignment by brute force (Klosowski et al. 1998; paper §2.1.1): encloses the nodes of one tree, given by their
/// vertices, in DOPs aligned to the other, by the least and the greatest projection of all vertices on each direction.
/// The result is the tightest DOP, at a cost of O(k²) a node.
///
/// Serves comparison with `DopAlignment`, whose DOPs are looser by rounding only.

#include <array>
#include <span>

#include "kernels/node_kernels.h"
#include "kernels/query_frame.h"
#include "tree/dop.h"
#include "tree/dop_vertices.h"

namespace glissade::collision {

/// The directions of the base in the frame of the nodes: rotating them once saves rotating every vertex.
struct VertexAlignment {
  VertexAlignment(const DopDirections& directions, const QueryFrame& frame);

  /// In axes of N, scaled so that projections of vertices in grid steps of N are in grid steps of M.
  std::array<std::array<float, 3>, kMostSlabs> direction;
  std::array<float, kMostSlabs> above;  ///< added to the greatest projection, in grid steps of M
  std::array<float, kMostSlabs> below;  ///< added to the negative of the least projection
  int slabs;
};

using RealignVertices = void (*)(const VertexAlignment& alignment, std::span<const VertexGroup> node_N,
                                 AlignedNode& aligned);

/// The function of the instruction set in use; realigns the four children of a node. Cost O(k²).
RealignVertices realign_vertices();

}  // namespace glissade::collision
