#include "suite.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include <glissade/collision/car_door_parts.h>
#include <glissade/collision/mesh_generators.h>
#include <glissade/collision/mesh_import.h>

namespace glissade::bench {
namespace {

using collision::TriangleMesh;
using Maker = TriangleMesh (*)(std::int64_t);

// The parts of the car door have about 50,000 triangles at detail 1.
double detail(std::int64_t triangles) {
  return static_cast<double>(triangles) / 50'000.0;
}

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all{
      {"sphere", [](std::int64_t n) { return collision::make_sphere(1.0, n); }},
      {"torus", [](std::int64_t n) { return collision::make_torus(0.7, 0.3, n); }},
      {"hyperboloid", [](std::int64_t n) { return collision::make_hyperboloid(0.4, 1.0, 2.0, n); }},
      {"window-motor", [](std::int64_t n) { return collision::make_window_motor(detail(n)); }},
  };
  return all;
}

TriangleMesh centred(TriangleMesh mesh, double size) {
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
  for (const auto& [name, maker] : makers())
    names.push_back(name);
  return names;
}

TriangleMesh make_shape(const std::string& shape, std::int64_t triangles, double size) {
  const auto found = makers().find(shape);
  if (found == makers().end()) throw std::invalid_argument("shape " + shape + " is unknown");
  return centred(found->second(triangles), size);
}

TriangleMesh make_plate_with_bumps(std::int64_t triangles, double size) {
  TriangleMesh mesh = collision::make_plate({size, size}, triangles);
  for (Eigen::Vector3d& p : mesh.vertices)
    p.z() = 0.05 * size * std::sin(12.566 * p.x() / size) * std::sin(12.566 * p.y() / size);
  return mesh;
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
    const auto mesh = std::make_shared<const TriangleMesh>(collision::import_mesh(file).mesh);
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), ',', '_');  // results.csv knows no quoting
    meshes.push_back({name, [mesh, size] { return centred(*mesh, size); }});
  }
  return meshes;
}

}  // namespace glissade::bench
