#pragma once

/// The meshes of the benchmarks: shapes at several numbers of triangles, and meshes of the user.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "bench_program.h"
#include "mesh_pair.h"

namespace glissade::bench {

/// Largest extent in metres of every mesh but the objects of scenes (Zachmann's procedure: objects of size 2).
inline constexpr double kSize = 2.0;

/// Seed of all random poses and scenes.
inline constexpr std::uint64_t kSeed = 1;

/// Two copies of a mesh, or two parts scaled alike so that the larger has the largest extent `kSize`. Both are centred
/// on their origins. The benches share them.
struct SuiteMesh {
  std::string name;  ///< "sphere-20k", the file's stem, or "gear+shaft"
  std::shared_ptr<Lazy<MeshPair>> pair;
  bool is_typical = false;  ///< of 20,000 triangles, or the user's: takes what costs too much for all
};

struct Suite {
  bool quick = false;
  std::vector<SuiteMesh> meshes;  ///< every generated shape at each size, then the user's meshes
  std::vector<SuiteMesh> large;   ///< every shape at a million triangles; nothing if quick
  std::vector<SuiteMesh> parts;   ///< two copies of each mesh of the user, then the user's pairs
};

/// Throws std::invalid_argument as `user_meshes` and `user_pairs`.
Suite make_suite(const BenchOptions& options);

/// All generated shapes with about `triangles` triangles, centred on their origins, with the largest extent `size`.
std::vector<geometry::TriangleMesh> all_shapes(std::int64_t triangles, double size);

/// "20k", "1M", or the number itself.
std::string short_count(std::int64_t count);

}  // namespace glissade::bench
