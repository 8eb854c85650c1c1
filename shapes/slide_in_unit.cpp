#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include <glissade/base/require.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/slide_in_unit.h>

namespace glissade::shapes {
namespace {

using Eigen::Vector3d;

void check_shape(const SlideInShape& shape) {
  base::require_positive("width", shape.width);
  base::require_positive("height", shape.height);
  base::require_positive("depth", shape.depth);
  base::require_positive("bezel_thickness", shape.bezel_thickness);
  base::require_positive("bezel_border", shape.bezel_border);
  base::require_positive("clearance", shape.clearance);
  base::require_positive("overlap", shape.overlap);
  base::require_below("clearance", shape.clearance, "the border of the bezel", shape.bezel_border);
  base::require_below("overlap", shape.overlap, "half the width", shape.width / 2);
  base::require_count("tongues_per_side", shape.tongues_per_side, 1, 100);
  base::require_triangle_count(shape.triangles);
}

geometry::TriangleMesh box_between(const Vector3d& low, const Vector3d& high, std::int64_t triangles) {
  return geometry::transformed(geometry::make_box(high - low, triangles),
                               Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))));
}

// The rectangle between two opposite corners that differ in two coordinates.
geometry::TriangleMesh sheet_between(const Vector3d& low, const Vector3d& high, std::int64_t triangles) {
  Vector3d::Index across = 0;
  (high - low).cwiseAbs().minCoeff(&across);
  const auto u = (across + 1) % 3;
  const auto v = (across + 2) % 3;
  const Vector3d size = high - low;
  geometry::TriangleMesh sheet = geometry::make_plate({size[u], size[v]}, triangles);
  for (Vector3d& point : sheet.vertices) {
    const Vector3d flat = point;
    point = 0.5 * (low + high);
    point[u] += flat.x();
    point[v] += flat.y();
  }
  return sheet;
}

// Rises from the wall at `x_wall` to its crest in the middle and falls back.
geometry::TriangleMesh tongue(double x_wall, double x_crest, double y_front, double length, double half_width) {
  geometry::TriangleMesh mesh;
  for (const double z : {-half_width, half_width}) {
    mesh.vertices.emplace_back(x_wall, y_front, z);
    mesh.vertices.emplace_back(x_crest, y_front + length / 2, z);
    mesh.vertices.emplace_back(x_wall, y_front + length, z);
  }
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

}  // namespace

geometry::TriangleMesh make_slide_in_unit(const SlideInShape& shape) {
  check_shape(shape);
  const double x = shape.width / 2;
  const double z = shape.height / 2;
  const double border = shape.bezel_border;
  const std::vector<geometry::TriangleMesh> components{
      box_between({-x, 0.0, -z}, {x, shape.depth, z}, shape.triangles / 2),
      box_between({-x - border, -shape.bezel_thickness, -z - border}, {x + border, 0.0, z + border},
                  shape.triangles / 2)};
  return geometry::merge(components);
}

geometry::TriangleMesh make_bay(const SlideInShape& shape) {
  check_shape(shape);
  const double x = shape.width / 2 + shape.clearance;
  const double z = shape.height / 2 + shape.clearance;
  const double y = shape.depth + shape.clearance;
  const double x_out = shape.width / 2 + shape.bezel_border;
  const double z_out = shape.height / 2 + shape.bezel_border;
  const auto share = std::max<std::int64_t>(2, shape.triangles / 9);
  const std::vector<geometry::TriangleMesh> sheets{sheet_between({-x, 0.0, -z}, {-x, y, z}, share),
                                                   sheet_between({x, 0.0, -z}, {x, y, z}, share),
                                                   sheet_between({-x, 0.0, -z}, {x, y, -z}, share),
                                                   sheet_between({-x, 0.0, z}, {x, y, z}, share),
                                                   sheet_between({-x, y, -z}, {x, y, z}, share),
                                                   sheet_between({-x_out, 0.0, -z_out}, {-x, 0.0, z_out}, share),
                                                   sheet_between({x, 0.0, -z_out}, {x_out, 0.0, z_out}, share),
                                                   sheet_between({-x, 0.0, -z_out}, {x, 0.0, -z}, share),
                                                   sheet_between({-x, 0.0, z}, {x, 0.0, z_out}, share)};
  return geometry::merge(sheets);
}

std::vector<geometry::TriangleMesh> make_bay_tongues(const SlideInShape& shape) {
  check_shape(shape);
  const double x_wall = shape.width / 2 + shape.clearance;
  const double x_crest = shape.width / 2 - shape.overlap;
  const double pitch = shape.depth / shape.tongues_per_side;
  std::vector<geometry::TriangleMesh> tongues;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < shape.tongues_per_side; ++i)
      tongues.push_back(tongue(side * x_wall, side * x_crest, (i + 0.25) * pitch, pitch / 2, shape.height / 8));
  }
  return tongues;
}

BayWithTongues make_bay_with_tongues(const SlideInShape& shape) {
  std::vector<geometry::TriangleMesh> components{make_bay(shape)};
  const std::size_t walls = components.front().triangles.size();
  for (geometry::TriangleMesh& tongue_mesh : make_bay_tongues(shape))
    components.push_back(std::move(tongue_mesh));
  BayWithTongues bay;
  bay.mesh = geometry::merge(components);
  bay.tongue_triangles.resize(bay.mesh.triangles.size() - walls);
  std::iota(bay.tongue_triangles.begin(), bay.tongue_triangles.end(), static_cast<std::int32_t>(walls));
  return bay;
}

}  // namespace glissade::shapes
