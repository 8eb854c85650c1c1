#pragma once

/// What a contact is, by the founding paper's counts of adjacent polygons (§3.2 and Figure 8).
///
/// The part is bracketed: at its visible pose it is free, at the collision object's pose, a fraction of a micrometre
/// on, some polygons p of it touch polygons q of obstacles. n_p is the number of polygons that share an edge with p and
/// touch q, n_q the same with p and q exchanged. A count of 0 may mean a rim: then it matters whether an edge of that
/// polygon meets the other one.
///
///   n_p   n_q   edge of p meets q   edge of q meets p   contact
///   1     1                                             edge/edge: the edges shared with the adjacent touching
///   polygons > 1   1                                             vertex/face: of p, and q 1     > 1 face/vertex 0 > 0
///   yes                                     edge/edge: a rim of p (a pipe and the rim of a hole in a sheet) 0     > 0
///   no                                      face/vertex: p is the face, the polygons about a vertex touch it > 0   0
///   yes                 edge/edge: a rim of q > 0   0                         no                  vertex/face 0     0
///   yes                 yes                 edge/edge: two rims 0     0     yes                 no vertex/face: the
///   corner of a sheet 0     0     no                  yes                 face/vertex 0     0     no no unclear:
///   coplanar, or they touch in a point > 1   > 1                                           whichever is larger is the
///   vertex; edge/edge when equal
///
/// The rows with n = 1 or > 1 and the question for rims are the paper's, the last two rows are ours: the paper has
/// "either n_p or n_q > 1, but not both", which an approximate contact does not keep to. Ours is also what is done
/// where the table says edge/edge or vertex/face, but no such features of p and q are near each other: the contact is
/// unclear then. (Flush faces: an upright edge of one meets the other face, far from any edge of it.) The order of
/// vertices is never used: a normal points to the side where the visible part is (random normals, sheets).

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "paper/collision_object.h"

namespace glissade::haptics {

enum class PaperContactKind : std::uint8_t {
  kVertexFace,  ///< a vertex of the part and a face of the obstacle
  kFaceVertex,
  kEdgeEdge,
  kUnclear,  ///< the table does not tell: where the two polygons are closest at the visible pose (ours)
};

/// What the table is read with. The last two matter, and are asked for, only where the count before is 0.
struct AdjacencyCounts {
  int n_p = 0;
  int n_q = 0;
  bool edge_of_p_meets_q = false;
  bool edge_of_q_meets_p = false;
};

PaperContactKind kind_of(const AdjacencyCounts& counts);

/// One contact point.
struct PaperContact {
  /// What touches: contacts of the same features are the same contact. Features are numbers of vertices, of edges
  /// (`MeshTopology`) or of triangles, as the kind says; of triangles where it is unclear.
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
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to where the visible part is
  Eigen::Vector3d p_V;  ///< the contact point on the part, in its frame, metres
  Eigen::Vector3d y_W;  ///< that on the obstacle

  /// How far the tangent plane is from the contact point when the part is at X_WV, metres.
  double gap_at(const Eigen::Isometry3d& X_WV) const { return n_W.dot(X_WV * p_V - y_W); }
};

/// Appends a contact for each of the `pairs`, which touch with the part at X_WC, as seen from X_WV, where none does and
/// where features in contact are not further apart than `near` (metres). Cost O(n log n). Thread-safe.
void classify_contacts(std::span<const Obstacle> obstacles, const SlidingPart& part_V,
                       std::span<const TouchingPair> pairs, const Eigen::Isometry3d& X_WC,
                       const Eigen::Isometry3d& X_WV, double near, std::vector<PaperContact>& contacts);

/// Orders contacts by their features and keeps the first of those that have the same.
void keep_first_of_each(std::vector<PaperContact>& contacts);

}  // namespace glissade::haptics
