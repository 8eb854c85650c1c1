#pragma once

/// Constants of a set of directions for `align`, in the layout of its vector code.

#include <array>
#include <cstdint>

#include "kernels/quarter_line.h"
#include "tree/dop.h"

namespace glissade::collision {

inline constexpr std::size_t kAlignmentLanes = 16;
inline constexpr std::size_t kMostGenericVertices = 2 * kMostSlabs - 2;
/// Two registers of 16 lanes.
inline constexpr std::size_t kVertexEntries = 32;
static_assert(kMostGenericVertices <= kVertexEntries);

/// Data of the vertices of the generic DOP (`generic_dop.h`), one of each mirrored pair.
struct alignas(64) AlignmentTable {
  int slabs;
  int vertex_count;
  alignas(64) std::array<std::array<float, kAlignmentLanes>, 3> direction;  ///< of each slab; 0 beyond the last
  std::array<std::array<float, 3>, kMostGenericVertices> position;          ///< of each vertex
  std::array<std::int32_t, kMostGenericVertices> number;                 ///< 0, 1, 2, …: faster to load than to count
  alignas(64) std::array<std::array<float, kVertexEntries>, 9> weights;  ///< [3 · term + axis][vertex]
  std::array<std::array<QuarterLine, 6>, 2 * kMostGenericVertices> source;  ///< [2 · vertex + mirrored][2 · term]
};

/// k as for `dop_directions`. Thread-safe.
const AlignmentTable& alignment_table(int k);

}  // namespace glissade::collision
