#include <cstddef>
#include <cstdint>

#include <glissade/geometry/triangle_pair.h>
#include <glissade/reference/brute_force.h>

namespace glissade::reference {
namespace {

// A triangle of positive area in the frame of A, with its box.
struct BoxedTriangle {
  geometry::TrianglePoints points;
  Eigen::Array3d low;
  Eigen::Array3d high;
  std::int32_t index;
};

// The triangles of `mesh` in the frame of A; `place` maps a vertex to that frame. Whether a triangle has an area is
// decided in the frame of the mesh, independently of the pose.
template <typename Place>
std::vector<BoxedTriangle> boxed_triangles(const geometry::TriangleMesh& mesh, const Place& place) {
  std::vector<Eigen::Vector3d> vertices_A;
  vertices_A.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    vertices_A.push_back(place(vertex));

  std::vector<BoxedTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    if (geometry::is_degenerate(mesh.corners(index))) continue;
    const auto corner_A = [&](std::size_t corner) -> const Eigen::Vector3d& {
      return vertices_A[static_cast<std::size_t>(mesh.triangles[i][corner])];
    };
    const geometry::TrianglePoints points{corner_A(0), corner_A(1), corner_A(2)};
    triangles.push_back({points, points[0].cwiseMin(points[1]).cwiseMin(points[2]),
                         points[0].cwiseMax(points[1]).cwiseMax(points[2]), index});
  }
  return triangles;
}

// Calls visit(triangle_A, triangle_B) for every intersecting pair until it returns true. Returns whether it did.
template <typename Visit>
bool visit_intersecting(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B,
                        const Eigen::Isometry3d& X_AB, const Visit& visit) {
  const auto triangles_A = boxed_triangles(mesh_A, [](const Eigen::Vector3d& v) { return v; });
  const auto triangles_B =
      boxed_triangles(mesh_B, [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return X_AB * v; });
  for (const BoxedTriangle& a : triangles_A) {
    for (const BoxedTriangle& b : triangles_B) {
      const bool boxes_meet = (a.low <= b.high).all() && (b.low <= a.high).all();
      if (boxes_meet && geometry::triangles_intersect(a.points, b.points) && visit(a.index, b.index)) return true;
    }
  }
  return false;
}

}  // namespace

bool brute_force_intersects(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B,
                            const Eigen::Isometry3d& X_AB) {
  return visit_intersecting(mesh_A, mesh_B, X_AB, [](std::int32_t, std::int32_t) { return true; });
}

std::vector<collision::TrianglePair> brute_force_pairs(const geometry::TriangleMesh& mesh_A,
                                                       const geometry::TriangleMesh& mesh_B,
                                                       const Eigen::Isometry3d& X_AB) {
  std::vector<collision::TrianglePair> pairs;
  visit_intersecting(mesh_A, mesh_B, X_AB, [&](std::int32_t triangle_A, std::int32_t triangle_B) {
    pairs.push_back({triangle_A, triangle_B});
    return false;
  });
  return pairs;
}

}  // namespace glissade::reference
