#pragma once

/// The kind of a contact, by the founding paper's counts of adjacent polygons (§3.2 and Figure 8).
///
/// The part is bracketed: at its visible pose it is free; at the pose of the collision object, a fraction of a
/// micrometre farther on, polygons p of the part touch polygons q of obstacles. n_p is the number of polygons that
/// share an edge with p and touch q; n_q is the same with p and q exchanged. A count of 0 may mean a rim; with it, the
/// kind depends on whether an edge of that polygon meets the other polygon.
///
// clang-format off
///   n_p   n_q   edge of p meets q   edge of q meets p   contact
///   1     1     –                   –                   edge/edge: the edges shared with the adjacent polygons
///   > 1   1     –                   –                   vertex/face: a vertex of p on q
///   1     > 1   –                   –                   face/vertex: a vertex of q on p
///   0     > 0   yes                 –                   edge/edge: a rim of p (a sheet with a hole, and a pipe in it)
///   0     > 0   no                  –                   face/vertex: p is the face, touched by polygons about a vertex
///   > 0   0     –                   yes                 edge/edge: a rim of q (a pipe, and the hole of a sheet)
///   > 0   0     –                   no                  vertex/face: q is the face
///   0     0     yes                 yes                 edge/edge: two rims
///   0     0     yes                 no                  vertex/face: the corner of a sheet on a face
///   0     0     no                  yes                 face/vertex: the same with p and q exchanged
///   0     0     no                  no                  unclear: coplanar, or touching in a point
///   > 1   > 1   –                   –                   vertex on the side of the larger count; edge/edge if equal
// clang-format on
///
/// The paper has the rows with counts of 1 and > 1 and the test for rims; it notes that both counts may be 0, without a
/// row for each outcome of the two tests. The last two rows are ours: the paper has "either n_p or n_q must be > 1 (but
/// not both)", which an approximate contact may violate. Another rule is ours: if the table yields edge/edge or
/// vertex/face, but p and q have no such features near each other, the contact is unclear. (Example, flush faces: an
/// upright edge of one body meets the face of the other, far from every edge of that face.) The order of vertices is
/// never used: a normal points to the side of the visible part, because normals from CAD point either way and sheets
/// have no inside.

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "paper/collision_object.h"

namespace glissade::reference {

enum class PaperContactKind : std::uint8_t {
  kVertexFace,  ///< a vertex of the part and a face of the obstacle
  kFaceVertex,
  kEdgeEdge,
  kUnclear,  ///< not decided by the table; between the closest points of p and q at the visible pose (ours)
};

/// The input of the table. Each flag is used, and computed, only if the count of the same polygon is 0.
struct AdjacencyCounts {
  int n_p = 0;
  int n_q = 0;
  bool edge_of_p_meets_q = false;
  bool edge_of_q_meets_p = false;
};

/// The kind of a contact, by the table.
PaperContactKind kind_of(const AdjacencyCounts& counts);

/// One contact point.
struct PaperContact {
  /// The features in contact, which identify the contact. Depending on the kind they are numbers of vertices, of edges
  /// (`geometry::MeshTopology`) or of triangles; both are triangles if the kind is unclear.
  struct Features {
    PaperContactKind kind;
    std::int32_t of_part;
    std::int32_t obstacle;  ///< number among the obstacles
    std::int32_t of_obstacle;

    auto operator<=>(const Features&) const = default;
  };

  Features features;
  std::int32_t part_triangle;
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit, from the obstacle towards the visible part
  Eigen::Vector3d p_V;  ///< the contact point on the part, in its frame, metres
  Eigen::Vector3d y_W;  ///< the contact point on the obstacle, metres

  /// Distance (metres) of the contact point from the tangent plane when the part is at X_WV.
  double gap_at(const Eigen::Isometry3d& X_WV) const { return n_W.dot(X_WV * p_V - y_W); }
};

/// Appends a contact for each of the `pairs`. They touch with the part at X_WC; none touches with the part at X_WV,
/// where features in contact are at most `near` (metres) apart. Cost O(n log n). Thread-safe.
void classify_contacts(std::span<const contact::Obstacle> obstacles, const contact::SlidingPart& part_V,
                       std::span<const TouchingPair> pairs, const Eigen::Isometry3d& X_WC,
                       const Eigen::Isometry3d& X_WV, double near, std::vector<PaperContact>& contacts);

/// Sorts contacts by their features, and keeps the first of those with the same features.
void keep_first_of_each(std::vector<PaperContact>& contacts);

}  // namespace glissade::reference
