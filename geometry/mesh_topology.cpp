#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_pair.h>

#include "mesh/straight_rims.h"

namespace glissade::geometry {
namespace {

/// Two triangles continue each other in one plane if the sine of the angle between their planes is at most this. The
/// value is well above the rounding errors of a tessellated plane with single-precision vertices, and well below any
/// bend that matters to a contact.
constexpr double kFlatSine = 1e-4;

/// One side of one triangle.
struct HalfEdge {
  std::array<std::int32_t, 2> vertices;  // ascending
  std::int32_t triangle;
  std::int32_t side;
};

/// By vertices, then by triangle. Few sides begin at a vertex, so that they are sorted there.
std::vector<HalfEdge> sorted(const std::vector<HalfEdge>& half_edges, std::size_t vertex_count) {
  std::vector<std::size_t> end(vertex_count + 1, 0);  // by vertex, of those before it; at last with its own
  for (const HalfEdge& h : half_edges)
    ++end[static_cast<std::size_t>(h.vertices[0]) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<HalfEdge> result(half_edges.size());
  for (const HalfEdge& h : half_edges)
    result[end[static_cast<std::size_t>(h.vertices[0])]++] = h;
  std::size_t first = 0;
  for (std::size_t v = 0; v < vertex_count; first = end[v++]) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.begin() + static_cast<std::ptrdiff_t>(end[v]),
              [](const HalfEdge& a, const HalfEdge& b) {
                return a.vertices[1] != b.vertices[1] ? a.vertices[1] < b.vertices[1] : a.triangle < b.triangle;
              });
  }
  return result;
}

bool continues_flat(const TriangleMesh& mesh, const std::array<std::int32_t, 2>& edge, std::int32_t apex_1,
                    std::int32_t apex_2) {
  const auto point = [&](std::int32_t v) -> const Eigen::Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(v)];
  };
  const Eigen::Vector3d along = point(edge[1]) - point(edge[0]);
  // Both cross products use the same direction of the edge, so a flat continuation has opposite normals and a fold
  // equal ones.
  const Eigen::Vector3d n1 = along.cross(point(apex_1) - point(edge[0]));
  const Eigen::Vector3d n2 = along.cross(point(apex_2) - point(edge[0]));
  return n1.dot(n2) < 0.0 && n1.cross(n2).norm() <= kFlatSine * n1.norm() * n2.norm();
}

std::vector<RimEdges> rim_edges(const TriangleMesh& mesh, std::span<const MeshTopology::Edge> edges) {
  std::vector<RimEdges> rims(mesh.vertices.size());
  for (const MeshTopology::Edge& edge : edges) {
    if (edge.flat) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      RimEdges& of_vertex = rims[static_cast<std::size_t>(edge.vertices[end])];
      if (of_vertex.count < 2) of_vertex.to[static_cast<std::size_t>(of_vertex.count)] = edge.vertices[1 - end];
      ++of_vertex.count;
    }
  }
  return rims;
}

}  // namespace

MeshTopology::MeshTopology(const TriangleMesh& mesh) {
  collect_edges(mesh);
  mark_flat(mesh);
  mark_stops(mesh);
  collect_neighbors(mesh);
}

void MeshTopology::collect_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  triangle_edges_.assign(mesh.triangles.size(), {-1, -1, -1});
  vertex_owner_.assign(mesh.vertices.size(), -1);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    if (is_degenerate(mesh.corners(t))) continue;
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
    for (std::int32_t side = 0; side < 3; ++side) {
      const std::int32_t u = triangle[static_cast<std::size_t>(side)];
      const std::int32_t v = triangle[static_cast<std::size_t>((side + 1) % 3)];
      half_edges.push_back({{std::min(u, v), std::max(u, v)}, t, side});
      std::int32_t& owner = vertex_owner_[static_cast<std::size_t>(u)];
      if (owner < 0) owner = t;
    }
  }
  half_edges = sorted(half_edges, mesh.vertices.size());

  apexes_.start.push_back(0);
  for (auto first = half_edges.begin(); first != half_edges.end();) {
    const auto last =
        std::find_if(first, half_edges.end(), [&](const HalfEdge& h) { return h.vertices != first->vertices; });
    const auto edge = static_cast<std::int32_t>(edges_.size());
    edges_.push_back({first->vertices, first->triangle, false});
    for (auto h = first; h != last; ++h) {
      triangle_edges_[static_cast<std::size_t>(h->triangle)][static_cast<std::size_t>(h->side)] = edge;
      apexes_.entries.push_back(
          mesh.triangles[static_cast<std::size_t>(h->triangle)][static_cast<std::size_t>((h->side + 2) % 3)]);
    }
    apexes_.start.push_back(static_cast<std::int32_t>(apexes_.entries.size()));
    first = last;
  }
}

void MeshTopology::mark_flat(const TriangleMesh& mesh) {
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(edges_.size()); ++e) {
    const auto apexes = apexes_of(e);
    Edge& edge = edges_[static_cast<std::size_t>(e)];
    edge.flat = apexes.size() == 2 && continues_flat(mesh, edge.vertices, apexes[0], apexes[1]);
  }
}

void MeshTopology::mark_stops(const TriangleMesh& mesh) {
  owned_features_.assign(mesh.triangles.size(), 0);
  const auto answer = [&](std::int32_t triangle, const std::array<std::int32_t, 3>& features, std::int32_t feature,
                          int first_bit) {
    const auto i = std::find(features.begin(), features.end(), feature) - features.begin();
    owned_features_[static_cast<std::size_t>(triangle)] |=
        static_cast<std::uint8_t>(1U << (first_bit + static_cast<int>(i)));
  };
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Edge& edge = edges_[e];
    if (edge.flat) continue;
    answer(edge.owner, edges_of(edge.owner), static_cast<std::int32_t>(e), 3);
  }
  const std::vector<RimEdges> rims = rim_edges(mesh, edges_);
  const std::vector<char> inside = inside_straight_rims(mesh, rims);
  can_stop_.assign(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (rims[v].count == 0 || inside[v] != 0) continue;
    can_stop_[v] = 1;
    answer(vertex_owner_[v], mesh.triangles[static_cast<std::size_t>(vertex_owner_[v])], static_cast<std::int32_t>(v),
           0);
  }
}

void MeshTopology::collect_neighbors(const TriangleMesh& mesh) {
  neighbors_.start.assign(mesh.vertices.size() + 1, 0);
  for (const Edge& edge : edges_) {
    for (const std::int32_t v : edge.vertices)
      ++neighbors_.start[static_cast<std::size_t>(v) + 1];
  }
  std::partial_sum(neighbors_.start.begin(), neighbors_.start.end(), neighbors_.start.begin());
  neighbors_.entries.resize(2 * edges_.size());
  std::vector<std::int32_t> next(neighbors_.start.begin(), neighbors_.start.end() - 1);
  for (const Edge& edge : edges_) {
    for (std::size_t end = 0; end < 2; ++end) {
      const auto v = static_cast<std::size_t>(edge.vertices[end]);
      neighbors_.entries[static_cast<std::size_t>(next[v]++)] = edge.vertices[1 - end];
    }
  }
}

}  // namespace glissade::geometry
