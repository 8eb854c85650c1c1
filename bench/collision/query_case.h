#pragma once

/// The benchmarks of queries: all subjects of a case ask the same question about two meshes at the same poses.

#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench_program.h"
#include "mesh_pair.h"

namespace glissade::bench {

enum class Operation { kIntersects, kCountPairs, kDistance };

using Poses = std::vector<Eigen::Isometry3d>;
/// Makes the poses of two objects.
using PosesOfTrees = std::function<Poses(const collision::DopTree& tree_A, const collision::DopTree& tree_B)>;

struct QueryCase {
  std::string name;  ///< BENCH/CASE
  std::shared_ptr<Lazy<MeshPair>> meshes;
  std::shared_ptr<Lazy<Poses>> poses;
  Operation operation = Operation::kIntersects;
};

/// The poses of a case, made of the trees of its meshes.
std::shared_ptr<Lazy<Poses>> lazy_poses(const std::shared_ptr<Lazy<MeshPair>>& meshes, PosesOfTrees make);

/// Registers NAME/SUBJECT for each subject. The answers of the first, Glissade, are what the others' are compared with.
///
/// Counters: `query`, seconds a query; `node_tests`, `realignments` and `triangle_tests`, means over the poses, of
/// subjects that count their work; `pairs`, the mean number of pairs; `colliding`, the number of colliding poses; of
/// all but the first subject, `disagreements`, the number of poses at which the answer differs; of the first,
/// `triangles` of mesh A and `poses`. A case for which no poses are found is skipped.
void register_queries(const QueryCase& query_case, const std::vector<Subject>& subjects);

/// The same for the case `NAME-sample`: `count` poses from all over the poses, which are series of `series` poses. One
/// series gives its first pose, the next its second, and so on.
void register_sample(QueryCase query_case, std::size_t series, std::size_t count, const std::vector<Subject>& subjects);

/// Measures passes over the poses, once caches hold the model of this subject again. Sets the counter `query`.
void measure_passes(benchmark::State& state, Query& query, const Poses& poses, Operation operation);

}  // namespace glissade::bench
