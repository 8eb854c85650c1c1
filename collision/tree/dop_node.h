#pragma once

/// What a DOP-tree is made of: nodes of four children, and leaves of four triangles.
///
/// Everything is laid out for vectors of four or more lanes: the values of four children, or of four triangles, stand
/// side by side. Node coordinates are integers on a grid of the object: 16 bits, rounded outward, so that a node of
/// four children takes four cache lines. What leaves the cache decides what a query costs.

#include <array>
#include <cstdint>

namespace glissade::collision {

/// Children of a node and triangles of a leaf.
inline constexpr int kWidth = 4;

/// Grid steps in the radius of an object. Small enough that three weighted offsets and a translation, summed up in
/// realignment, do not leave 16 bits by more than what saturation may cut (`dop_alignment.h`).
inline constexpr int kGridRadius = 16000;

/// One value of each child.
using FourValues = std::array<std::int16_t, kWidth>;

/// Both offsets of one slab of four children: points x of a child satisfy b·x ≤ above and −b·x ≤ below, in grid steps
/// from the centre of the object.
struct SlabRow {
  FourValues above;
  FourValues below;
};

/// Four cache lines of it make a 24-DOP node: this line, and `slab_lines` more that hold four slabs each.
///
/// Children that are nodes come first, then those that are leaves; each kind is stored consecutively.
struct alignas(64) NodeHead {
  // The thin slab of each child: its points lie within `half_width` of the plane normal·(x − c) = offset, where c is
  // the middle of its first three slabs, and within `radius` of c. In grid steps; the normal in 1/32767.
  std::array<FourValues, 3> normal;
  FourValues offset;
  FourValues half_width;
  FourValues radius;

  std::uint32_t first_node;  ///< of the children that are nodes
  std::uint32_t first_leaf;  ///< of the children that are leaves
  std::uint8_t node_count;
  std::uint8_t leaf_count;
  std::uint8_t thin;  ///< bit c: the thin slab of child c tells more than its DOP
  std::uint8_t unused[5];

  int child_count() const { return node_count + leaf_count; }
  bool is_leaf(int child) const { return child >= node_count; }
  std::uint32_t child(int c) const {
    return is_leaf(c) ? first_leaf + static_cast<std::uint32_t>(c - node_count)
                      : first_node + static_cast<std::uint32_t>(c);
  }
};
static_assert(sizeof(NodeHead) == 64);

/// The second to last lines of a node. Slabs beyond those of its directions hold the whole grid.
struct alignas(64) SlabLine {
  std::array<SlabRow, 4> rows;
};
static_assert(sizeof(SlabLine) == 64);

/// Lines of a node that hold slabs.
constexpr int slab_lines(int slabs) {
  return (slabs + 3) / 4;
}

/// Up to four triangles, corners in units of the object's radius from its centre, rounded to single precision.
struct alignas(32) TriangleLeaf {
  std::array<std::array<std::array<float, kWidth>, 3>, 3> corner;  ///< [axis][corner][triangle]
  std::array<std::int32_t, kWidth> triangle;  ///< of the mesh; −1 − triangle for one without area, kNoTriangle for none
};
static_assert(sizeof(TriangleLeaf) == 160);

inline constexpr std::int32_t kNoTriangle = INT32_MIN;

}  // namespace glissade::collision
