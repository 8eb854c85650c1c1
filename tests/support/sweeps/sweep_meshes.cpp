#include "sweeps/sweep_meshes.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "cgal_oracle.h"

namespace glissade::test_support {
namespace {

using Eigen::Vector3d;
using geometry::Triangle;
using geometry::TriangleMesh;

void add_triangle(const Vector3d& p, const Vector3d& q, const Vector3d& r, geometry::TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {p, q, r});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

geometry::TriangleMesh soup(int triangles, RandomNumbers& random) {
  const double edge = random.uniform(0.05, 0.4);
  geometry::TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vector3d p = random.point(0.6);
    const Vector3d q = p + random.point(edge);
    add_triangle(p, q, p + random.point(edge), mesh);
  }
  return mesh;
}

// Triangles far longer than wide, some so thin that a motion makes them degenerate.
geometry::TriangleMesh needles(int triangles, RandomNumbers& random) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vector3d p = random.point(0.6);
    const Vector3d along = random.uniform(0.1, 1.0) * random.direction();
    add_triangle(p, p + along, p + random.uniform(0.0, 1.0) * along + random.power_of_ten(-10, -2) * random.direction(),
                 mesh);
  }
  return mesh;
}

geometry::TriangleMesh ribs(int triangles, RandomNumbers& random) {
  const int count = random.integer(1, 6);
  const double width = random.power_of_ten(-3.0, -1.5);
  std::vector<geometry::TriangleMesh> boxes;
  for (int i = 0; i < count; ++i) {
    boxes.push_back(geometry::make_box({2.0, width, 10.0 * width}, std::max(12, triangles / count)));
    for (Vector3d& vertex : boxes.back().vertices)
      vertex.y() += 3.0 * width * i;
  }
  return geometry::merge(boxes);
}

// Coplanar triangles in several planes, some less than a rounding error of their size apart.
geometry::TriangleMesh layers(int triangles, RandomNumbers& random) {
  const int count = random.integer(1, 5);
  const double step = random.power_of_ten(-17.0, -1.0);
  geometry::TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const double z = step * (i % count);
    const auto point = [&] { return Vector3d(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), z); };
    const Vector3d p = point();
    const Vector3d q = point();
    add_triangle(p, q, point(), mesh);
  }
  return mesh;
}

geometry::Triangle shuffled(const geometry::Triangle& triangle, RandomNumbers& random) {
  geometry::Triangle result = triangle;
  std::swap(result[0], result[static_cast<std::size_t>(random.integer(0, 2))]);
  std::swap(result[1], result[static_cast<std::size_t>(random.integer(1, 2))]);
  return result;
}

// Repeats some triangles, in any order of their corners, and adds some without an area.
void spoil(geometry::TriangleMesh& mesh, RandomNumbers& random) {
  const auto count = mesh.triangles.size();
  const auto any_triangle = [&] {
    return mesh.triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(count) - 1))];
  };
  const int additions = random.integer(1, static_cast<int>(count) / 2);
  for (int i = 0; i < additions; ++i) {
    const geometry::Triangle triangle = any_triangle();
    const int kind = random.integer(0, 3);
    if (kind == 0) mesh.triangles.push_back({triangle[0], triangle[0], triangle[0]});
    if (kind == 1) mesh.triangles.push_back({triangle[1], triangle[0], triangle[1]});
    if (kind >= 2) mesh.triangles.push_back(shuffled(triangle, random));
  }
}

bool has_area(const geometry::TriangleMesh& mesh) {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.triangles.size()); ++i) {
    if (!cgal_is_degenerate(mesh.corners(i))) return true;
  }
  return false;
}

std::pair<geometry::TriangleMesh, std::string> random_unit_mesh(RandomNumbers& random) {
  const int triangles = random.chance(0.2) ? random.integer(60, 200) : random.integer(10, 60);
  switch (random.integer(0, 6)) {
    case 0:
      return {soup(triangles, random), "soup"};
    case 1:
      return {needles(triangles, random), "needles"};
    case 2:
      return {ribs(triangles, random), "ribs"};
    case 3:
      return {layers(triangles, random), "layers"};
    case 4:
      return {geometry::make_box({random.uniform(0.2, 1.2), random.uniform(0.2, 1.2), 1.0}, triangles), "box"};
    default:
      return {random_surface(triangles, random), "surface"};
  }
}

geometry::TriangleMesh integer_soup(int reach, int triangles, RandomNumbers& random) {
  geometry::TriangleMesh mesh;
  const auto point = [&] {
    const int x = random.integer(-reach, reach);
    const int y = random.integer(-reach, reach);
    return Vector3d(x, y, random.integer(-reach, reach));
  };
  for (int i = 0; i < triangles; ++i) {
    const Vector3d p = point();
    const Vector3d q = point();
    add_triangle(p, q, point(), mesh);
  }
  return mesh;
}

// All six faces of unit cubes, split along a random diagonal; where cubes meet, faces coincide.
geometry::TriangleMesh cubes(int reach, int count, RandomNumbers& random) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const int x = random.integer(-reach, reach - 1);
    const int y = random.integer(-reach, reach - 1);
    const Vector3d low(x, y, random.integer(-reach, reach - 1));
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d u = Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = Vector3d::Unit((axis + 2) % 3);
      for (const Vector3d& p : {low, Vector3d(low + Vector3d::Unit(axis))}) {
        if (random.chance(0.5)) {
          add_triangle(p, p + u, p + v, mesh);
          add_triangle(p + u, p + u + v, p + v, mesh);
        } else {
          add_triangle(p, p + u, p + u + v, mesh);
          add_triangle(p, p + u + v, p + v, mesh);
        }
      }
    }
  }
  return mesh;
}

SweepMesh finished(const geometry::TriangleMesh& unit_mesh, double size, const Vector3d& center,
                   const std::string& kind) {
  SweepMesh result{unit_mesh, size, center, kind + ", " + std::to_string(unit_mesh.triangles.size()) + " triangles"};
  for (Vector3d& vertex : result.mesh.vertices)
    vertex = center + size * vertex;
  return result;
}

}  // namespace

SweepMesh random_mesh(double size, const Vector3d& center, RandomNumbers& random) {
  for (;;) {
    auto [unit_mesh, kind] = random_unit_mesh(random);
    if (random.chance(0.25)) {
      spoil(unit_mesh, random);
      kind = "spoilt " + kind;
    }
    if (random.chance(0.5)) {
      // So that not all planes and edges are parallel to the axes.
      const Eigen::Matrix3d R = random.rotation();
      for (Vector3d& vertex : unit_mesh.vertices)
        vertex = R * vertex;
    }
    SweepMesh result = finished(unit_mesh, size, center, kind);
    if (has_area(result.mesh)) return result;
  }
}

SweepMesh random_grid_mesh(double cell, const Vector3d& center, RandomNumbers& random) {
  constexpr std::array<int, 6> kReaches{1, 1, 2, 3, 5, 30};
  const int reach = kReaches[static_cast<std::size_t>(random.integer(0, 5))];
  for (;;) {
    const bool soup_of_triangles = random.chance(0.5);
    geometry::TriangleMesh mesh = soup_of_triangles ? integer_soup(reach, random.integer(5, 60), random)
                                                    : cubes(reach, random.integer(1, 8), random);
    const std::string kind = soup_of_triangles ? "integer soup" : "cubes";
    if (random.chance(0.2)) spoil(mesh, random);
    SweepMesh result = finished(mesh, cell, center, kind + " of reach " + std::to_string(reach));
    result.size = cell * reach;
    if (has_area(result.mesh)) return result;
  }
}

void deform(geometry::TriangleMesh& mesh, double size, RandomNumbers& random) {
  const std::vector<Vector3d> vertices = mesh.vertices;
  const auto any_vertex = [&] {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(vertices.size()) - 1));
  };
  do {
    const double reach = size * random.power_of_ten(-6.0, 0.0);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      mesh.vertices[i] = vertices[i] + random.point(reach);
    for (std::size_t i = 0; i < vertices.size() / 10; ++i)
      mesh.vertices[any_vertex()] = mesh.vertices[any_vertex()];
  } while (!has_area(mesh));
}

geometry::TriangleMesh random_surface(int triangles, RandomNumbers& random) {
  switch (random.integer(0, 4)) {
    case 0:
      return geometry::make_sphere(1.0, triangles);
    case 1:
      return geometry::make_torus(0.8, random.uniform(0.05, 0.5), triangles);
    case 2:
      return geometry::make_hyperboloid(random.uniform(0.1, 0.5), 0.8, 1.0, triangles);
    case 3:
      return geometry::make_tube(random.uniform(0.02, 0.5), 1.5, triangles);
    default:
      return geometry::make_plate({random.uniform(0.1, 1.5), 1.5}, triangles);
  }
}

}  // namespace glissade::test_support
