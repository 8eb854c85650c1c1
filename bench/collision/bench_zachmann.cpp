// See `run_zachmann` in benches.h.

#include <memory>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "subject_lists.h"
#include "zachmann_poses.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using geometry::TriangleMesh;

constexpr std::int64_t kSweepTriangles = 20'000;  // where the number of directions is varied

std::vector<Subject> subjects_for(const std::string& mesh_name) {
  const bool sweep = mesh_name.ends_with("-" + short_count(kSweepTriangles));
  return join({usual_subjects(), glissade_as_published(), sweep ? glissade_directions() : std::vector<Subject>{}});
}

void run(const SuiteMesh& suite_mesh, const std::vector<Subject>& subjects, const BenchOptions& options,
         Results& results) {
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(suite_mesh.make());
  const DopTree tree(mesh);
  PoseSource source(tree, tree, options.seed);
  run_query_case(
      {.bench = kZachmannName,
       .name = suite_mesh.name,
       .mesh_A = *mesh,
       .mesh_B = *mesh,
       .poses = with_sample(zachmann_poses(source, options.quick), kZachmannDistances, options.quick ? 10 : 20)},
      subjects, pass_limits(options), results);
}

}  // namespace

PassLimits pass_limits(const BenchOptions& options) {
  if (options.quick) return {.least = 2, .most = 41, .seconds = 0.1};
  return {};
}

void run_zachmann(const BenchOptions& options, Results& results) {
  for (const SuiteMesh& mesh : suite_meshes(options.suite, options.suite.triangles))
    run(mesh, subjects_for(mesh.name), options, results);
  results.add_ratios(kZachmannName, kPeers);
  run_extremes(options, results);  // not among the ratios
}

}  // namespace glissade::bench
