// See `run_zachmann` in benches.h.

#include <algorithm>
#include <memory>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using collision::TriangleMesh;
using Eigen::Isometry3d;

constexpr const char* kName = "zachmann";
constexpr std::int64_t kSweepTriangles = 20'000;  // where the number of directions is varied

constexpr int kDistances = 10;

std::vector<Isometry3d> zachmann_poses(PoseSource& source, bool quick) {
  const int orientations = quick ? 10 : 20;
  constexpr int kAxes = 5;

  std::vector<Isometry3d> poses;
  for (int i = 0; i < orientations; ++i) {
    const Eigen::Matrix3d R_AB = source.rotation();
    for (int j = 0; j < kAxes; ++j) {
      const Eigen::Vector3d axis = source.direction();
      const double apart = source.box_separation(R_AB, axis);
      for (int k = 0; k < kDistances; ++k)
        poses.push_back(pose(R_AB, apart * k / (kDistances - 1) * axis));
    }
  }
  return poses;
}

void append(std::vector<Subject>& subjects, std::vector<Subject> more) {
  std::move(more.begin(), more.end(), std::back_inserter(subjects));
}

std::vector<Subject> subjects_for(const std::string& mesh_name) {
  std::vector<Subject> subjects{glissade_subject()};
  append(subjects, glissade_as_published());
  append(subjects, glissade_instruction_sets());
  if (mesh_name.ends_with("-" + short_count(kSweepTriangles))) append(subjects, glissade_directions());
  append(subjects, peers());
  return subjects;
}

void run(const SuiteMesh& suite_mesh, const std::vector<Subject>& subjects, const BenchOptions& options,
         Results& results) {
  const auto mesh = std::make_shared<const TriangleMesh>(suite_mesh.make());
  const DopTree tree(mesh);
  PoseSource source(tree, tree, options.seed);
  run_query_case({.bench = kName,
                  .name = suite_mesh.name,
                  .mesh_A = *mesh,
                  .mesh_B = *mesh,
                  .poses = with_sample(zachmann_poses(source, options.quick), kDistances, options.quick ? 10 : 20)},
                 subjects, pass_limits(options), results);
}

}  // namespace

PassLimits pass_limits(const BenchOptions& options) {
  if (options.quick) return {.least = 2, .most = 11, .seconds = 0.1};
  return {};
}

void run_zachmann(const BenchOptions& options, Results& results) {
  for (const SuiteMesh& mesh : suite_meshes(options.suite, options.suite.triangles))
    run(mesh, subjects_for(mesh.name), options, results);
  results.add_ratios(kName, {"fcl", "ode", "bullet", "cgal"});
}

}  // namespace glissade::bench
