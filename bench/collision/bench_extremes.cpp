// See `run_extremes` in benches.h.

#include <cmath>
#include <memory>

#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "subject_lists.h"
#include "zachmann_poses.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using geometry::TriangleMesh;

constexpr std::int64_t kSmall = 1'000;
constexpr std::int64_t kLargeMesh = 1'000'000;
constexpr std::int64_t kFarTriangles = 20'000;

void run_far_pair(const BenchOptions& options, Results& results) {
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, kFarTriangles));
  const DopTree tree(mesh);
  PoseSource source(tree, tree, options.seed);
  std::vector<Eigen::Isometry3d> poses;
  while (poses.size() < 500)
    poses.push_back(pose(source.rotation(), 3.0 * source.direction()));
  run_query_case({.bench = kZachmannName,
                  .name = "far-spheres",
                  .mesh_A = *mesh,
                  .mesh_B = *mesh,
                  .poses = with_sample(poses, 1, 10)},
                 usual_subjects(), pass_limits(options), results);
}

double time_of(const Results& results, const std::string& case_name) {
  for (const Row& row : results.rows()) {
    if (row.bench == kZachmannName && row.case_name == case_name && row.subject == "glissade" && row.metric == "time")
      return row.value;
  }
  return 0.0;
}

void run_million(const BenchOptions& options, Results& results) {
  double log_sum = 0.0;
  int count = 0;
  for (const std::string& shape : options.suite.shapes) {
    const std::string name = shape + "-" + short_count(kLargeMesh);
    {
      const auto mesh = std::make_shared<const geometry::TriangleMesh>(make_shape(shape, kLargeMesh, kSize));
      const DopTree tree(mesh);
      PoseSource source(tree, tree, options.seed);
      run_query_case({.bench = kZachmannName,
                      .name = name,
                      .mesh_A = *mesh,
                      .mesh_B = *mesh,
                      .poses = with_sample(zachmann_poses(source, options.quick), kZachmannDistances, 20)},
                     {glissade_subject()}, pass_limits(options), results);
    }
    const double small = time_of(results, shape + "-" + short_count(kSmall));
    if (small == 0.0) continue;
    log_sum += std::log(time_of(results, name) / small);
    ++count;
  }
  if (count > 0) results.add({kZachmannName, "growth", "glissade", "time_1M_by_1k", std::exp(log_sum / count), "x"});
}

}  // namespace

void run_extremes(const BenchOptions& options, Results& results) {
  run_far_pair(options, results);
  if (!options.quick) run_million(options, results);
}

}  // namespace glissade::bench
