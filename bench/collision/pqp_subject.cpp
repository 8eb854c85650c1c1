// The published method of PQP in our own implementation (see pqp/tree.h), in single precision and compiled for the
// processor of the machine: trees of oriented boxes for yes or no and all pairs, of rectangles swept by spheres for
// distances. Like PQP, the distance begins with the two triangles that were nearest in the last query.

#include "pqp/build.h"
#include "pqp/query.h"
#include "subject.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;

struct PqpModel : Model {
  explicit PqpModel(const geometry::TriangleMesh& mesh) : tree(pqp::build_tree(mesh)) {}
  pqp::Tree tree;
};

pqp::Pose pqp_pose(const Isometry3d& X_AB) {
  pqp::Pose pose{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j)
      pose.rows[i][j] = static_cast<float>(X_AB(i, j));
  }
  return pose;
}

class PqpQuery : public Query {
 public:
  PqpQuery(const Model& model_A, const Model& model_B)
      : tree_A_(dynamic_cast<const PqpModel&>(model_A).tree), tree_B_(dynamic_cast<const PqpModel&>(model_B).tree) {}

  void forget() override { nearest_ = {0, 0}; }
  bool intersects(const Isometry3d& X_AB) override { return pqp::intersects(tree_A_, tree_B_, pqp_pose(X_AB)); }
  std::int64_t count_pairs(const Isometry3d& X_AB) override {
    std::size_t count = pqp::intersecting_pairs(tree_A_, tree_B_, pqp_pose(X_AB), pairs_);
    if (count > pairs_.size()) {  // as a rule in the first pass, which is not timed
      pairs_.resize(count);
      count = pqp::intersecting_pairs(tree_A_, tree_B_, pqp_pose(X_AB), pairs_);
    }
    return static_cast<std::int64_t>(count);
  }
  double distance(const Isometry3d& X_AB) override {
    return static_cast<double>(pqp::distance(tree_A_, tree_B_, pqp_pose(X_AB), nearest_));
  }

 private:
  const pqp::Tree& tree_A_;
  const pqp::Tree& tree_B_;
  std::vector<pqp::TriangleIds> pairs_;
  pqp::TriangleIds nearest_{0, 0};
};

}  // namespace

Subject pqp_subject() {
  return {
      .name = "pqp",
      .model = "pqp",
      .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<PqpModel>(mesh); },
      .query = [](const Model& model_A, const Model& model_B) { return std::make_unique<PqpQuery>(model_A, model_B); }};
}

}  // namespace glissade::bench
