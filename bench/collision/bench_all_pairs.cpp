// See `run_all_pairs` in benches.h.

#include <memory>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Isometry3d;
using geometry::TriangleMesh;

constexpr const char* kAllPairsName = "all-pairs";

// Between a third of the contact distance and contact, so that objects overlap like parts that a hand pushes together.
std::vector<Isometry3d> overlapping_poses(const DopTree& tree, const BenchOptions& options) {
  PoseSource source(tree, tree, options.seed);
  const std::size_t wanted = options.quick ? 30 : 100;
  std::vector<Isometry3d> poses;
  collision::QueryWorkspace workspace;
  for (std::size_t tries = 0; poses.size() < wanted && tries < 10 * wanted; ++tries) {
    const Eigen::Matrix3d R_AB = source.rotation();
    const Eigen::Vector3d axis = source.direction();
    const auto contact = source.approach(R_AB, axis, 0.0);
    if (!contact) continue;
    const Isometry3d X_AB = pose(R_AB, source.uniform(0.3, 1.0) * *contact * axis);
    if (collision::intersects(tree, tree, X_AB, workspace)) poses.push_back(X_AB);
  }
  return poses;
}

}  // namespace

void run_all_pairs(const BenchOptions& options, Results& results) {
  const std::vector<Subject> subjects =
      join({{glissade_subject()}, glissade_instruction_sets(), peers_that_count_pairs()});
  for (const SuiteMesh& suite_mesh : suite_meshes(options.suite, options.suite.triangles)) {
    const auto mesh = std::make_shared<const geometry::TriangleMesh>(suite_mesh.make());
    run_query_case({.bench = kAllPairsName,
                    .name = suite_mesh.name,
                    .mesh_A = *mesh,
                    .mesh_B = *mesh,
                    .poses = with_sample(overlapping_poses(DopTree(mesh), options), 1, 10),
                    .operation = Operation::kCountPairs},
                   subjects, pass_limits(options), results);
  }
  results.add_ratios(kAllPairsName, kPeers);
}

}  // namespace glissade::bench
