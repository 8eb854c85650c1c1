#pragma once

/// The data of the published method of PQP: a binary tree of a mesh with one triangle a leaf. Each node has an oriented
/// box (Gottschalk, Lin, Manocha, "OBBTree: a hierarchical structure for rapid interference detection", SIGGRAPH 1996)
/// and a rectangle swept by a sphere (Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere
/// volumes", 1999). This is our implementation from these papers, in single precision; it has no line of PQP.
///
/// Plain floats only: sources with other compiler flags share this header.

#include <cstdint>
#include <vector>

namespace glissade::bench::pqp {

/// Rows of a rotation, each followed by its coordinate of the translation.
struct alignas(16) Pose {
  float rows[3][4];
};

/// A cache line. P is the frame of the parent's box; that of the mesh for the root. The origin is the box's centre.
struct alignas(64) BoxNode {
  Pose X_PN;
  float half[3];       ///< half of the extents, the largest first
  std::int32_t child;  ///< the first of two adjacent children, or ~t for triangle t
};

/// A cache line. P is the frame of the parent's rectangle. The rectangle spans x and y from a corner at the origin.
struct alignas(64) RectangleNode {
  Pose X_PN;
  float sides[2];
  float radius;        ///< of the sphere that sweeps the rectangle
  std::int32_t child;  ///< as that of the box
};

/// Corners of a triangle in the frame of the mesh; the fourth repeats the first.
struct alignas(16) TriangleNode {
  float x[4];
  float y[4];
  float z[4];
};

struct Tree {
  std::vector<BoxNode> boxes;             ///< the root first
  std::vector<RectangleNode> rectangles;  ///< in the same order
  std::vector<TriangleNode> triangles;    ///< in the order of the leaves
  std::vector<std::int32_t> ids;          ///< of these triangles, in the mesh
};

}  // namespace glissade::bench::pqp
