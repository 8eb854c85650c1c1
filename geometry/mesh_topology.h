#pragma once

/// Which triangles of a mesh meet in which edges and vertices, without any use of their orientation: what contact
/// constraints need to know of a mesh straight from CAD.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Edges and vertices of a mesh with their neighborhoods. Degenerate triangles take no part.
/// Immutable after construction, so safe to share between threads.
class MeshTopology {
 public:
  struct Edge {
    std::array<std::int32_t, 2> vertices;
    std::int32_t owner;  ///< the one of its triangles that answers for it
    bool flat;           ///< exactly two triangles meet here, and they continue each other in one plane
  };

  /// Cost O(n log n).
  explicit MeshTopology(const TriangleMesh& mesh);

  const std::vector<Edge>& edges() const { return edges_; }

  /// The edges of a triangle: entry i joins its corners i and i + 1. Entries are −1 for a degenerate triangle.
  const std::array<std::int32_t, 3>& edges_of(std::int32_t triangle) const {
    return triangle_edges_[static_cast<std::size_t>(triangle)];
  }
  /// The corners that face an edge, one for each of its triangles.
  std::span<const std::int32_t> apexes_of(std::int32_t edge) const { return apexes_.of(edge); }
  /// The vertices joined to a vertex by an edge.
  std::span<const std::int32_t> neighbors_of(std::int32_t vertex) const { return neighbors_.of(vertex); }
  /// The one of a vertex's triangles that answers for it, −1 if it has none.
  std::int32_t owner_of(std::int32_t vertex) const { return vertex_owner_[static_cast<std::size_t>(vertex)]; }
  /// Whether a vertex can stop another mesh. One inside a plane patch, where every edge is flat, cannot, as others
  /// bound the patch; nor can one inside a straight rim, where all edges are flat but two that continue each other,
  /// within 0.1 µm of the chord: what it could stop, the ends of the rim stop, or its edges.
  bool can_stop(std::int32_t vertex) const { return can_stop_[static_cast<std::size_t>(vertex)] != 0; }
  /// Whether a triangle answers for any edge that is not flat or vertex that can stop: only those stop another mesh.
  bool answers_for_features(std::int32_t triangle) const { return answers_[static_cast<std::size_t>(triangle)] != 0; }
  /// Whether two triangles of two meshes can stop each other: not those of which one answers for edges only and the
  /// other for none, as an edge is stopped by edges and vertices.
  bool can_stop_each_other(std::int32_t triangle, const MeshTopology& other, std::int32_t triangle_of_other) const {
    const int mine = answers_[static_cast<std::size_t>(triangle)];
    const int others = other.answers_[static_cast<std::size_t>(triangle_of_other)];
    return (mine & kCorners) != 0 || (others & kCorners) != 0 || (mine != 0 && others != 0);
  }
  /// Whether it answers for its corner i, and for its edge i.
  bool answers_for_corner(std::int32_t triangle, int i) const { return answers(triangle, i); }
  bool answers_for_edge(std::int32_t triangle, int i) const { return answers(triangle, 3 + i); }

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

  bool answers(std::int32_t triangle, int feature) const {
    return (answers_[static_cast<std::size_t>(triangle)] >> feature & 1) != 0;
  }

  void collect_edges(const TriangleMesh& mesh);
  void mark_flat(const TriangleMesh& mesh);
  void mark_stops(const TriangleMesh& mesh);
  void collect_neighbors(const TriangleMesh& mesh);

  std::vector<Edge> edges_;
  std::vector<std::array<std::int32_t, 3>> triangle_edges_;
  std::vector<std::int32_t> vertex_owner_;
  std::vector<char> can_stop_;
  std::vector<std::uint8_t> answers_;  // bits 0 to 2 for the corners of a triangle, 3 to 5 for its edges
  Lists apexes_;
  Lists neighbors_;
};

}  // namespace glissade::geometry
