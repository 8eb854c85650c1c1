#pragma once

/// Edges and vertices of a mesh with the triangles that meet there, and the features that contact constraints need. The
/// orientation of triangles is not used, so meshes straight from CAD will do.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Edges and vertices of a mesh with their neighborhoods. Each edge and each vertex has one owner among its triangles,
/// so that every contact is found once, always with the same numbers. Degenerate triangles are ignored. Immutable after
/// construction, so safe to share between threads.
///
/// Features are the edges that are not flat and the vertices that can stop another mesh. In every contact of two
/// meshes, a vertex of one meets a face, edge or vertex of the other, or an edge of one meets an edge of the other.
class MeshTopology {
 public:
  struct Edge {
    std::array<std::int32_t, 2> vertices;
    std::int32_t owner;  ///< the triangle that owns the edge
    bool flat;           ///< exactly two triangles meet here, side by side in one plane
  };

  /// Cost O(n log n).
  explicit MeshTopology(const TriangleMesh& mesh);

  const std::vector<Edge>& edges() const { return edges_; }

  /// The edges of a triangle: entry i joins its corners i and i + 1. Entries are −1 for a degenerate triangle.
  const std::array<std::int32_t, 3>& edges_of(std::int32_t triangle) const {
    return triangle_edges_[static_cast<std::size_t>(triangle)];
  }
  /// The vertices opposite an edge, one for each of its triangles.
  std::span<const std::int32_t> apexes_of(std::int32_t edge) const { return apexes_.of(edge); }
  /// The vertices joined to a vertex by an edge.
  std::span<const std::int32_t> neighbors_of(std::int32_t vertex) const { return neighbors_.of(vertex); }
  /// The triangle that owns a vertex; −1 if no triangle, or only degenerate ones, use the vertex.
  std::int32_t owner_of(std::int32_t vertex) const { return vertex_owner_[static_cast<std::size_t>(vertex)]; }
  /// Whether a vertex can stop another mesh. A vertex inside a plane patch cannot: all its edges are flat, and the
  /// features that bound the patch suffice. Neither can a vertex inside a straight rim: exactly two of its edges are
  /// not flat, these two continue each other, and it lies within 0.1 µm of the rim's chord. The edges and the ends of
  /// the rim suffice.
  bool can_stop(std::int32_t vertex) const { return can_stop_[static_cast<std::size_t>(vertex)] != 0; }
  /// Whether a triangle owns any feature. A triangle that owns none stops only vertices of other meshes, with its face.
  bool answers_for_features(std::int32_t triangle) const { return answers_[static_cast<std::size_t>(triangle)] != 0; }
  /// Whether two triangles of two meshes can stop each other with the features that they own. A vertex stops any
  /// triangle, but an edge stops only edges and vertices. So one of the triangles must own a vertex, or both must own
  /// features.
  bool can_stop_each_other(std::int32_t triangle, const MeshTopology& other, std::int32_t triangle_of_other) const {
    const int mine = answers_[static_cast<std::size_t>(triangle)];
    const int others = other.answers_[static_cast<std::size_t>(triangle_of_other)];
    return (mine & kCorners) != 0 || (others & kCorners) != 0 || (mine != 0 && others != 0);
  }
  /// Whether corner i, or edge i, of a triangle is a feature that the triangle owns.
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
  std::vector<std::uint8_t> answers_;  // by triangle, features that it owns: bits 0 to 2 corners, 3 to 5 edges
  Lists apexes_;
  Lists neighbors_;
};

}  // namespace glissade::geometry
