// FCL: OBBRSS tree, first contact for the boolean, all contacts as pairs of triangles (without contact points, which
// Glissade does not compute either) for the pairs, no cost sources; distances with the closest points.

#include <limits>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "fcl_model.h"
#include "subject.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;

struct FclModel : Model {
  explicit FclModel(const geometry::TriangleMesh& mesh) : tree(fcl_tree(mesh)) {}
  FclTree tree;
};

class FclQuery : public Query {
 public:
  FclQuery(const Model& model_A, const Model& model_B)
      : tree_A_(dynamic_cast<const FclModel&>(model_A).tree), tree_B_(dynamic_cast<const FclModel&>(model_B).tree) {}

  bool intersects(const Isometry3d& X_AB) override { return contacts(X_AB, 1) > 0; }
  std::int64_t count_pairs(const Isometry3d& X_AB) override {
    return static_cast<std::int64_t>(contacts(X_AB, std::numeric_limits<std::size_t>::max()));
  }
  double distance(const Isometry3d& X_AB) override {
    const fcl::DistanceRequest<double> request(true);
    distance_.clear();
    return fcl::distance(&tree_A_, Isometry3d::Identity(), &tree_B_, X_AB, request, distance_);
  }

 private:
  std::size_t contacts(const Isometry3d& X_AB, std::size_t limit) {
    const fcl::CollisionRequest<double> request(limit);
    result_.clear();
    return fcl::collide(&tree_A_, Isometry3d::Identity(), &tree_B_, X_AB, request, result_);
  }

  const FclTree& tree_A_;
  const FclTree& tree_B_;
  fcl::CollisionResult<double> result_;
  fcl::DistanceResult<double> distance_;
};

}  // namespace

Subject fcl_subject() {
  return {
      .name = "fcl",
      .model = "fcl",
      .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<FclModel>(mesh); },
      .query = [](const Model& model_A, const Model& model_B) { return std::make_unique<FclQuery>(model_A, model_B); }};
}

}  // namespace glissade::bench
