#include "suite.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <glissade/shapes/benchmark_shapes.h>

#include "user_meshes.h"

namespace glissade::bench {
namespace {

using geometry::TriangleMesh;

TriangleMesh of_size(const TriangleMesh& mesh, double size) {
  return centered(mesh, size / largest_extent(mesh));
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
    if (known.name == shape) return of_size(known.make(triangles), size);
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
  for (const UserMesh& user : user_meshes(suite.files))
    meshes.push_back({user.name, [mesh = user.mesh, size] { return of_size(*mesh, size); }});
  return meshes;
}

std::vector<PartPair> part_pairs(const Suite& suite) {
  const std::vector<UserMesh> meshes = user_meshes(suite.files);
  std::vector<PartPair> pairs;
  for (const UserMesh& user : meshes) {
    const auto copy = std::make_shared<const TriangleMesh>(of_size(*user.mesh, kSize));
    pairs.push_back({user.name, copy, copy});
  }
  if (suite.pairs.empty()) return pairs;
  for (const UserPair& user : user_pairs(suite.pairs, meshes)) {
    const TriangleMesh& mesh_A = *user.mesh_A.mesh;
    const TriangleMesh& mesh_B = *user.mesh_B.mesh;
    const double scale = kSize / std::max(largest_extent(mesh_A), largest_extent(mesh_B));
    pairs.push_back({user.mesh_A.name + "/" + user.mesh_B.name,
                     std::make_shared<const TriangleMesh>(centered(mesh_A, scale)),
                     std::make_shared<const TriangleMesh>(centered(mesh_B, scale))});
  }
  return pairs;
}

}  // namespace glissade::bench
