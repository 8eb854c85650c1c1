#include "convex_shapes.h"

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::test_support {

using Eigen::Vector3d;

geometry::TriangleMesh hull_mesh(std::span<const Vector3d> points) {
  geometry::TriangleMesh mesh;
  mesh.vertices.assign(points.begin(), points.end());
  const auto count = static_cast<std::int32_t>(points.size());
  const auto point = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
  for (std::int32_t i = 0; i < count; ++i) {
    for (std::int32_t j = i + 1; j < count; ++j) {
      for (std::int32_t k = j + 1; k < count; ++k) {
        const Vector3d normal = (point(j) - point(i)).cross(point(k) - point(i));
        int above = 0;
        for (std::int32_t l = 0; l < count; ++l)
          above += l != i && l != j && l != k && normal.dot(point(l) - point(i)) > 0.0 ? 1 : 0;
        if (above == 0) mesh.triangles.push_back({i, j, k});
        if (above == count - 3) mesh.triangles.push_back({i, k, j});
      }
    }
  }
  return geometry::weld(mesh);
}

geometry::TriangleMesh random_convex_mesh(RandomNumbers& random, double radius) {
  switch (random.integer(0, 2)) {
    case 0: {
      const double x = random.uniform(0.5, 2.0);
      const double y = random.uniform(0.5, 2.0);
      const double z = random.uniform(0.5, 2.0);
      return geometry::make_box(radius * Vector3d(x, y, z), random.chance(0.5) ? 12 : 200);
    }
    case 1:
      return geometry::make_sphere(radius, 300);
    default:
      break;
  }
  std::vector<Vector3d> points;
  for (int i = 0; i < 14; ++i)
    points.push_back(radius * random.direction().cwiseProduct(Vector3d(1.0, 1.3, 0.7)));
  return hull_mesh(points);
}

}  // namespace glissade::test_support
