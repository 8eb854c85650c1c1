// See `register_zachmann` in benches.h.

#include <memory>

#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "pair_poses.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;

constexpr std::int64_t kFarTriangles = 20'000;

QueryCase zachmann_case(const SuiteMesh& mesh, bool quick) {
  return {"zachmann/" + mesh.name, mesh.pair, lazy_poses(mesh.pair, zachmann_poses(quick ? 10 : 20))};
}

Poses far_poses(const DopTree& tree_A, const DopTree& tree_B) {
  PoseSource source(tree_A, tree_B, kSeed);
  Poses poses;
  while (poses.size() < 500)
    poses.push_back(pose(source.rotation(), 3.0 * source.direction()));
  return poses;
}

}  // namespace

void register_zachmann(const Suite& suite) {
  for (const SuiteMesh& mesh : suite.meshes) {
    const QueryCase query_case = zachmann_case(mesh, suite.quick);
    const bool with_directions = mesh.is_typical;
    register_queries(query_case, join({fast_subjects(true), glissade_as_published(),
                                       with_directions ? glissade_directions() : std::vector<Subject>{}}));
    register_sample(query_case, kZachmannDistances, suite.quick ? 10 : 20, sample_subjects());
  }
  const auto spheres = lazy([] { return MeshPair(geometry::make_sphere(1.0, kFarTriangles)); });
  register_queries({"zachmann/far-spheres", spheres, lazy_poses(spheres, far_poses)},
                   join({fast_subjects(false), {ode_subject(), bullet_subject(), cgal_subject()}}));
  for (const SuiteMesh& mesh : suite.large)
    register_queries(zachmann_case(mesh, suite.quick), {glissade_subject()});
}

}  // namespace glissade::bench
