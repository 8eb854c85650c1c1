#pragma once

/// Edges and vertices of a mesh, the triangles that meet at them, and features. Features are the edges and vertices
/// that can make contact constraints. `report` counts the elements and defects of a mesh. The orientation of triangles
/// is not used, so meshes exported from CAD are suitable.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Edges and vertices of a mesh with their neighborhoods. Each edge and each vertex has one owner, i.e. one of the
/// triangles that meet at it. A contact search considers an edge or vertex only at its owner. So the search finds every
/// contact once, always with the same feature numbers. Degenerate triangles are ignored. Immutable after construction,
/// so threads may share an object.
///
/// Features are the edges that are not flat (`Edge::flat`) and the vertices that can stop another mesh (`can_stop`). A
/// feature stops another mesh if a contact at this feature keeps the two meshes apart. In every contact of two meshes,
/// a vertex of one mesh meets a face, edge or vertex of the other mesh, or two edges meet.
class GLISSADE_EXPORT MeshTopology {
 public:
  struct Edge {
    std::array<std::int32_t, 2> vertices;
    std::int32_t owner;  ///< the triangle that owns the edge
    bool flat;           ///< the edge joins exactly two triangles, which lie side by side in one plane
  };

  /// Cost O(n log n).
  explicit MeshTopology(const TriangleMesh& mesh);

  const std::vector<Edge>& edges() const { return edges_; }

  /// The numbers of the edges of a triangle; −1 for a degenerate triangle. Edge i joins corners i and (i + 1) mod 3.
  const std::array<std::int32_t, 3>& edges_of(std::int32_t triangle) const {
    return triangle_edges_[static_cast<std::size_t>(triangle)];
  }
  /// The vertices opposite an edge, one vertex for each triangle at the edge.
  std::span<const std::int32_t> apexes_of(std::int32_t edge) const { return apexes_.of(edge); }
  /// The vertices joined to a vertex by an edge.
  std::span<const std::int32_t> neighbors_of(std::int32_t vertex) const { return neighbors_.of(vertex); }
  /// The triangle that owns a vertex; −1 if no triangle with an area uses the vertex.
  std::int32_t owner_of(std::int32_t vertex) const { return vertex_owner_[static_cast<std::size_t>(vertex)]; }
  /// Whether a vertex can stop another mesh. All vertices can stop another mesh, except vertices inside a plane patch
  /// or inside a straight rim. A vertex is inside a plane patch if all its edges are flat. In place of such a vertex,
  /// the features on the boundary of the patch stop other meshes. A rim is a chain of edges that are not flat. A rim
  /// ends at vertices where it bends or meets other rims. A vertex is inside a straight rim if three conditions hold:
  /// - Exactly two edges of the vertex are not flat.
  /// - These two edges continue each other without a bend.
  /// - The vertex lies within 0.1 µm of the chord between the ends of the rim.
  ///
  /// In place of such a vertex, the edges and end vertices of the rim stop other meshes.
  bool can_stop(std::int32_t vertex) const { return can_stop_[static_cast<std::size_t>(vertex)] != 0; }
  /// Whether a triangle owns any feature. A triangle without a feature stops other meshes only with its face. A face
  /// stops only vertices.
  bool owns_stopping_feature(std::int32_t triangle) const {
    return owned_features_[static_cast<std::size_t>(triangle)] != 0;
  }
  /// Whether two triangles of two meshes can stop each other with features that they own. They can if at least one
  /// triangle owns a vertex that can stop another mesh, or if both triangles own edges that are not flat. A vertex
  /// stops any triangle, but an edge stops only edges and vertices.
  bool can_stop_each_other(std::int32_t triangle, const MeshTopology& other, std::int32_t triangle_of_other) const {
    const int mine = owned_features_[static_cast<std::size_t>(triangle)];
    const int others = other.owned_features_[static_cast<std::size_t>(triangle_of_other)];
    return (mine & kCorners) != 0 || (others & kCorners) != 0 || (mine != 0 && others != 0);
  }
  /// Whether corner i (or edge i) of a triangle is a feature that the triangle owns.
  bool owns_corner(std::int32_t triangle, int i) const { return owns(triangle, i); }
  bool owns_edge(std::int32_t triangle, int i) const { return owns(triangle, 3 + i); }

 private:
  /// A list for each of n items, stored end to end.
  struct Lists {
    std::vector<std::int32_t> start;
    std::vector<std::int32_t> entries;
    std::span<const std::int32_t> of(std::int32_t item) const {
      const auto i = static_cast<std::size_t>(item);
      return {entries.data() + start[i], entries.data() + start[i + 1]};
    }
  };

  static constexpr int kCorners = 7;

  bool owns(std::int32_t triangle, int feature) const {
    return (owned_features_[static_cast<std::size_t>(triangle)] >> feature & 1) != 0;
  }

  void collect_edges(const TriangleMesh& mesh);
  void mark_flat(const TriangleMesh& mesh);
  void mark_stops(const TriangleMesh& mesh);
  void collect_neighbors(const TriangleMesh& mesh);

  std::vector<Edge> edges_;
  std::vector<std::array<std::int32_t, 3>> triangle_edges_;
  std::vector<std::int32_t> vertex_owner_;
  std::vector<char> can_stop_;
  std::vector<std::uint8_t> owned_features_;  // by triangle: bits 0 to 2 corners, 3 to 5 edges
  Lists apexes_;
  Lists neighbors_;
};

/// Size and defects of a mesh, as information for the user. Meshes with these defects are valid input for this library.
/// The counts are meaningful for welded meshes, because edges and components are found by shared vertex indices, not by
/// positions. Degenerate triangles count only in `triangles` and `degenerate`.
struct MeshReport {
  std::int64_t vertices = 0;            ///< including vertices that no triangle uses
  std::int64_t triangles = 0;           ///< including degenerate triangles
  std::int64_t degenerate = 0;          ///< triangles without area
  std::int64_t duplicates = 0;          ///< triangles with the same three vertices as an earlier triangle
  std::int64_t open_edges = 0;          ///< boundary edges, i.e. edges of only one triangle
  std::int64_t nonmanifold_edges = 0;   ///< edges of more than two triangles
  std::int64_t inconsistent_edges = 0;  ///< edges that exactly two triangles share and traverse in the same direction
  std::int64_t components = 0;          ///< sets of triangles connected through shared vertices
  bool is_watertight = false;           ///< true if there are triangles, but no open and no non-manifold edges
  double area = 0;                      ///< in m²
  Eigen::AlignedBox3d bounds;           ///< in metres; empty without triangles
};

/// Counts the elements and defects of a mesh. Throws std::invalid_argument for an index out of range. Cost O(n log n).
GLISSADE_EXPORT MeshReport report(const TriangleMesh& mesh);

}  // namespace glissade::geometry
