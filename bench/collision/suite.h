#pragma once

/// The meshes of the benchmarks: shapes at several numbers of triangles, and meshes of the user.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::bench {

/// Largest extent in metres of every mesh, except in `coherent` (Zachmann's procedure: objects of size 2).
inline constexpr double kSize = 2.0;

/// One mesh of the suite, made when it is needed: a mesh of a million triangles is not kept.
struct SuiteMesh {
  std::string name;  ///< "sphere-20k", or the file's stem
  std::function<geometry::TriangleMesh()> make;
};

struct Suite {
  std::vector<std::string> shapes;             ///< names of generated shapes
  std::vector<std::int64_t> triangles;         ///< numbers of triangles of each
  std::vector<std::int64_t> shell_triangles;   ///< the same for `shells`
  std::int64_t coherent_triangles = 0;         ///< the same for `coherent`
  std::vector<std::int64_t> scene_triangles;   ///< the same for the objects of `scene` and `threads`
  std::vector<std::int64_t> thread_triangles;  ///< the same for the pairs of `threads`
  std::vector<std::int64_t> hull_vertices;     ///< numbers of corners for `hull`
  std::vector<std::filesystem::path> files;    ///< meshes of the user; a folder stands for all meshes in it
  std::filesystem::path pairs;                 ///< a file for `user_pairs`; or empty
};

/// Names of all generated shapes, those of shapes/benchmark_shapes.h.
std::vector<std::string> all_shapes();

/// The shape with about `triangles` triangles, centred on the origin, with the largest extent `size`. Throws
/// std::invalid_argument for an unknown name.
geometry::TriangleMesh make_shape(const std::string& shape, std::int64_t triangles, double size);

/// Every shape at each of the sizes, then the user's meshes, centred on the origin and scaled to the largest extent
/// `size`. Throws std::invalid_argument for a file that cannot be used.
std::vector<SuiteMesh> suite_meshes(const Suite& suite, const std::vector<std::int64_t>& triangles,
                                    double size = kSize);

/// Two meshes, centred on their origins and scaled alike, so that the larger has the largest extent `kSize`.
struct PartPair {
  std::string name;
  std::shared_ptr<const geometry::TriangleMesh> mesh_A;
  std::shared_ptr<const geometry::TriangleMesh> mesh_B;  ///< the same object for two copies of one mesh
};

/// Two copies of each mesh of the user, then the pairs of `Suite::pairs`. Throws as `user_meshes` and `user_pairs`.
std::vector<PartPair> part_pairs(const Suite& suite);

/// "20k", "1M", or the number itself.
std::string short_count(std::int64_t count);

}  // namespace glissade::bench
