#include "suite.h"

#include <algorithm>
#include <utility>

#include <glissade/shapes/benchmark_shapes.h>

#include "user_meshes.h"

namespace glissade::bench {
namespace {

using geometry::TriangleMesh;

constexpr std::int64_t kTypical = 20'000;
constexpr std::int64_t kLarge = 1'000'000;

TriangleMesh of_size(const TriangleMesh& mesh, double size) {
  return centered(mesh, size / largest_extent(mesh));
}

void add_shape(const shapes::BenchmarkShape& shape, std::int64_t triangles, std::vector<SuiteMesh>& meshes) {
  meshes.push_back({shape.name + "-" + short_count(triangles),
                    lazy([shape, triangles] { return MeshPair(of_size(shape.make(triangles), kSize)); }),
                    triangles == kTypical});
}

MeshPair scaled_alike(const TriangleMesh& mesh_A, const TriangleMesh& mesh_B) {
  const double scale = kSize / std::max(largest_extent(mesh_A), largest_extent(mesh_B));
  return {std::make_shared<const TriangleMesh>(centered(mesh_A, scale)),
          std::make_shared<const TriangleMesh>(centered(mesh_B, scale))};
}

}  // namespace

std::string short_count(std::int64_t count) {
  if (count >= 1'000'000 && count % 1'000'000 == 0) return std::to_string(count / 1'000'000) + "M";
  if (count >= 1'000 && count % 1'000 == 0) return std::to_string(count / 1'000) + "k";
  return std::to_string(count);
}

std::vector<TriangleMesh> all_shapes(std::int64_t triangles, double size) {
  std::vector<TriangleMesh> meshes;
  for (const shapes::BenchmarkShape& shape : shapes::benchmark_shapes())
    meshes.push_back(of_size(shape.make(triangles), size));
  return meshes;
}

Suite make_suite(const BenchOptions& options) {
  Suite suite{options.quick, {}, {}, {}};
  std::vector<std::int64_t> sizes{1'000, kTypical};
  if (!suite.quick) sizes.push_back(100'000);
  for (const shapes::BenchmarkShape& shape : shapes::benchmark_shapes()) {
    for (const std::int64_t triangles : sizes)
      add_shape(shape, triangles, suite.meshes);
    if (!suite.quick) add_shape(shape, kLarge, suite.large);
  }
  const std::vector<UserMesh> of_user = user_meshes(options.meshes);
  for (const UserMesh& user : of_user)
    suite.parts.push_back({user.name, lazy([mesh = user.mesh] { return MeshPair(of_size(*mesh, kSize)); }), true});
  if (options.pairs.empty()) return suite;
  for (const UserPair& user : user_pairs(options.pairs, of_user)) {
    suite.parts.push_back({user.mesh_A.name + "+" + user.mesh_B.name,
                           lazy([user] { return scaled_alike(*user.mesh_A.mesh, *user.mesh_B.mesh); }), true});
  }
  return suite;
}

}  // namespace glissade::bench
