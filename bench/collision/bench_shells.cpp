// See `run_shells` in benches.h.

#include <memory>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/shapes/benchmark_shapes.h>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

constexpr const char* kShellsName = "shells";
constexpr double kGap = 0.02;  // of the radius of the sphere, of half the size of the plate

// B inside A, turned about their common centre.
std::vector<Isometry3d> nested_poses(PoseSource& source, std::size_t count) {
  std::vector<Isometry3d> poses;
  while (poses.size() < count)
    poses.push_back(pose(source.rotation(), Vector3d::Zero()));
  return poses;
}

// B above A, with the bumps of one in the dents of the other: shifts along the plate are small against the gap.
std::vector<Isometry3d> stacked_poses(PoseSource& source, std::size_t count) {
  std::vector<Isometry3d> poses;
  while (poses.size() < count) {
    const double shift = 0.1 * kGap;
    poses.push_back(
        pose(Eigen::Matrix3d::Identity(), {source.uniform(-shift, shift), source.uniform(-shift, shift), kGap}));
  }
  return poses;
}

}  // namespace

void run_shells(const BenchOptions& options, Results& results) {
  const std::vector<Subject> subjects = usual_subjects();
  const std::size_t count = options.quick ? 10 : 40;
  for (const std::int64_t triangles : options.suite.shell_triangles) {
    const auto outer = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, triangles));
    const auto inner = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0 - kGap, triangles));
    const DopTree outer_tree(outer);
    PoseSource source(outer_tree, outer_tree, options.seed);
    run_query_case({.bench = kShellsName,
                    .name = "nested-spheres-" + short_count(triangles),
                    .mesh_A = *outer,
                    .mesh_B = *inner,
                    .poses = with_sample(nested_poses(source, count), 1, 10)},
                   subjects, pass_limits(options), results);
    const geometry::TriangleMesh plate = shapes::make_bumpy_plate({kSize, kSize}, 0.1 * kSize, 4, triangles);
    run_query_case({.bench = kShellsName,
                    .name = "bumpy-plates-" + short_count(triangles),
                    .mesh_A = plate,
                    .mesh_B = plate,
                    .poses = with_sample(stacked_poses(source, count), 1, 10)},
                   subjects, pass_limits(options), results);
  }
  results.add_ratios(kShellsName, kPeers);
}

}  // namespace glissade::bench
