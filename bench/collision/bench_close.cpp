// See `run_close` in benches.h.

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

constexpr const char* kCloseName = "close";

struct RelativeGap {
  const char* name;
  double share;  // of the size
};
constexpr RelativeGap kRelativeGaps[] = {{"gap-0.1%", 0.001}, {"gap-0.3%", 0.003}, {"gap-1%", 0.01}};

std::vector<Isometry3d> close_poses(const DopTree& tree, double gap, const BenchOptions& options) {
  PoseSource source(tree, tree, options.seed);
  const std::size_t wanted = options.quick ? 50 : 200;
  std::vector<Isometry3d> poses;
  for (std::size_t tries = 0; poses.size() < wanted && tries < 10 * wanted; ++tries) {
    const Eigen::Matrix3d R_AB = source.rotation();
    const Eigen::Vector3d axis = source.direction();
    if (const auto distance = source.approach(R_AB, axis, gap)) poses.push_back(pose(R_AB, *distance * axis));
  }
  return poses;
}

}  // namespace

void run_close(const BenchOptions& options, Results& results) {
  const std::vector<Subject> subjects = usual_subjects();
  for (const SuiteMesh& suite_mesh : suite_meshes(options.suite, options.suite.triangles)) {
    const auto mesh = std::make_shared<const geometry::TriangleMesh>(suite_mesh.make());
    const DopTree tree(mesh);
    for (const RelativeGap& gap : kRelativeGaps) {
      run_query_case({.bench = kCloseName,
                      .name = suite_mesh.name + "-" + gap.name,
                      .mesh_A = *mesh,
                      .mesh_B = *mesh,
                      .poses = with_sample(close_poses(tree, gap.share * kSize, options), 1, 10)},
                     subjects, pass_limits(options), results);
    }
  }
  results.add_ratios(kCloseName, kPeers);
}

}  // namespace glissade::bench
