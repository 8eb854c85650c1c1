#include "suite.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_import.h>
#include <glissade/shapes/benchmark_shapes.h>

namespace glissade::bench {
namespace {

using geometry::TriangleMesh;
geometry::TriangleMesh centered(geometry::TriangleMesh mesh, double size) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    box.extend(vertex);
  const double scale = size / box.sizes().maxCoeff();
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex = scale * (vertex - box.center());
  return mesh;
}

}  // namespace

std::vector<std::string> all_shapes() {
  std::vector<std::string> names;
  for (const shapes::BenchmarkShape& shape : shapes::benchmark_shapes())
    names.push_back(shape.name);
  return names;
}

geometry::TriangleMesh make_shape(const std::string& shape, std::int64_t triangles, double size) {
  for (const shapes::BenchmarkShape& known : shapes::benchmark_shapes()) {
    if (known.name == shape) return centered(known.make(triangles), size);
  }
  throw std::invalid_argument("shape " + shape + " is unknown");
}

std::string short_count(std::int64_t count) {
  if (count >= 1'000'000 && count % 1'000'000 == 0) return std::to_string(count / 1'000'000) + "M";
  if (count >= 1'000 && count % 1'000 == 0) return std::to_string(count / 1'000) + "k";
  return std::to_string(count);
}

std::vector<SuiteMesh> suite_meshes(const Suite& suite, const std::vector<std::int64_t>& triangles, double size) {
  std::vector<SuiteMesh> meshes;
  for (const std::string& shape : suite.shapes) {
    for (const std::int64_t count : triangles) {
      meshes.push_back(
          {shape + "-" + short_count(count), [shape, count, size] { return make_shape(shape, count, size); }});
    }
  }
  for (const std::filesystem::path& file : suite.files) {
    const auto mesh = std::make_shared<const geometry::TriangleMesh>(geometry::import_mesh(file).mesh);
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), ',', '_');  // results.csv has no quoting
    meshes.push_back({name, [mesh, size] { return centered(*mesh, size); }});
  }
  return meshes;
}

}  // namespace glissade::bench
