#pragma once

/// Realignment by brute force (Klosowski et al. 1998; paper §2.1.1): the nodes of one tree, represented by their
/// vertices, are enclosed by DOPs of another frame by taking the least and the greatest projection of all vertices on
/// each direction. That is the tightest DOP there is, for O(k²) operations a node.
///
/// Here to be compared with `DopAlignment`, whose results are looser by rounding only.

#include <array>
#include <span>

#include "kernels/node_kernels.h"
#include "kernels/query_frame.h"
#include "tree/dop.h"
#include "tree/dop_vertices.h"

namespace glissade::collision {

/// The directions of the base seen by the nodes: turning those once saves turning every vertex.
struct VertexAlignment {
  VertexAlignment(const DopDirections& directions, const QueryFrame& frame);

  std::array<std::array<float, 3>, kMostSlabs> direction;  ///< grid steps of the base in one of the other tree
  std::array<float, kMostSlabs> above;  ///< grid steps of the base to be added to the greatest projection
  std::array<float, kMostSlabs> below;  ///< and to the negative of the least
  int slabs;
};

using RealignVertices = void (*)(const VertexAlignment& alignment, std::span<const VertexGroup> node_N,
                                 AlignedNode& aligned);

/// That of the instruction set in use; realigns the four children of a node. O(k²).
RealignVertices realign_vertices();

}  // namespace glissade::collision
