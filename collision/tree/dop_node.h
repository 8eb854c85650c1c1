#pragma once

/// Memory layout of a DOP-tree: nodes with up to four children, and leaves with up to four triangles.
///
/// The layout suits SIMD vectors of four or more lanes: the values of four children, or of four triangles, lie side by
/// side. Node coordinates are integers on a grid of the object: 16 bits, rounded outward, so that a node of four
/// children takes four cache lines. Cache misses determine the cost of a query.

#include <array>
#include <cstdint>

namespace glissade::collision {

/// Maximum number of children of a node, and of triangles of a leaf.
inline constexpr int kWidth = 4;

/// Grid steps in the radius of an object. So small that the sum of three weighted offsets and a translation in
/// realignment exceeds 16 bits only where saturation is harmless (`dop_alignment.h`).
inline constexpr int kGridRadius = 16000;

/// One value for each child.
using FourValues = std::array<std::int16_t, kWidth>;

/// The two offsets of one slab for four children. Every point x of a child satisfies b·x ≤ above and −b·x ≤ below, in
/// grid steps from the centre of the object.
struct SlabRow {
  FourValues above;
  FourValues below;
};

/// The first cache line of a node. `slab_lines` further lines hold four slabs each; a 24-DOP node takes four lines in
/// all.
///
/// Inner nodes come first among the children, then leaves. Each kind is stored consecutively.
struct alignas(64) NodeHead {
  // The thin slab of each child: its points lie within `half_width` of the plane normal·(x − c) = offset and within
  // `radius` of c, the centre of the box of the first three slabs. Units: grid steps; for the normal 1/32767.
  std::array<FourValues, 3> normal;
  FourValues offset;
  FourValues half_width;
  FourValues radius;

  std::uint32_t first_node;  ///< number of the first child that is a node
  std::uint32_t first_leaf;  ///< number of the first child that is a leaf
  std::uint8_t node_count;
  std::uint8_t leaf_count;
  std::uint8_t thin;  ///< bit c: the thin slab of child c is worth its test
  std::uint8_t unused[5];

  int child_count() const { return node_count + leaf_count; }
  bool is_leaf(int child) const { return child >= node_count; }
  std::uint32_t child(int c) const {
    return is_leaf(c) ? first_leaf + static_cast<std::uint32_t>(c - node_count)
                      : first_node + static_cast<std::uint32_t>(c);
  }
};
static_assert(sizeof(NodeHead) == 64);

/// Any further cache line of a node. Unused slabs of the last line contain the whole grid.
struct alignas(64) SlabLine {
  std::array<SlabRow, 4> rows;
};
static_assert(sizeof(SlabLine) == 64);

/// Number of cache lines that hold `slabs` slabs.
constexpr int slab_lines(int slabs) {
  return (slabs + 3) / 4;
}

/// Up to four triangles. Corners are relative to the object's centre, in units of its radius, rounded to single
/// precision.
struct alignas(32) TriangleLeaf {
  std::array<std::array<std::array<float, kWidth>, 3>, 3> corner;  ///< [axis][corner][triangle]
  /// Indices in the mesh; −1 − index for a triangle without area, kNoTriangle for an unused place.
  std::array<std::int32_t, kWidth> triangle;
};
static_assert(sizeof(TriangleLeaf) == 160);

inline constexpr std::int32_t kNoTriangle = INT32_MIN;

}  // namespace glissade::collision
