// See `register_shells` in benches.h.

#include <glissade/geometry/mesh_generators.h>
#include <glissade/shapes/benchmark_shapes.h>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Vector3d;
using geometry::TriangleMesh;

constexpr double kGap = 0.02;  // of the radius of the sphere, of half the size of the plate

// B inside A, turned about their common centre.
Eigen::Isometry3d nested(PoseSource& source) {
  return pose(source.rotation(), Vector3d::Zero());
}

// B above A, with the bumps of one in the dents of the other: shifts along the plate are small against the gap.
Eigen::Isometry3d stacked(PoseSource& source) {
  const double shift = 0.1 * kGap;
  const double x = source.uniform(-shift, shift);
  return pose(Eigen::Matrix3d::Identity(), {x, source.uniform(-shift, shift), kGap});
}

void register_shell(const std::string& name, const std::shared_ptr<Lazy<MeshPair>>& meshes,
                    Eigen::Isometry3d (*place)(PoseSource&)) {
  const QueryCase query_case{"shells/" + name, meshes,
                             lazy_poses(meshes, [place](const DopTree& tree_A, const DopTree& tree_B) {
                               PoseSource source(tree_A, tree_B, kSeed);
                               Poses poses(20);
                               for (Eigen::Isometry3d& X_AB : poses)
                                 X_AB = place(source);
                               return poses;
                             })};
  register_queries(query_case, fast_subjects(true));
  register_sample(query_case, 1, 3, sample_subjects());
}

}  // namespace

void register_shells(const Suite& suite) {
  const std::int64_t triangles = suite.quick ? 20'000 : 100'000;
  register_shell("nested-spheres-" + short_count(triangles), lazy([triangles] {
                   return MeshPair(std::make_shared<const TriangleMesh>(geometry::make_sphere(1.0, triangles)),
                                   std::make_shared<const TriangleMesh>(geometry::make_sphere(1.0 - kGap, triangles)));
                 }),
                 nested);
  register_shell("bumpy-plates-" + short_count(triangles), lazy([triangles] {
                   return MeshPair(shapes::make_bumpy_plate({kSize, kSize}, 0.1 * kSize, 4, triangles));
                 }),
                 stacked);
}

}  // namespace glissade::bench
