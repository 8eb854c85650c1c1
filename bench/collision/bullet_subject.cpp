// Bullet: GImpact, its only algorithm for two concave meshes, without collision margin, as the package builds it
// (single precision). It has no boolean query: it collects all overlapping pairs of boxes, then
// makes contacts of them; neither step can be stopped early from outside.

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <btBulletCollisionCommon.h>

#include "bullet_model.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;

// Takes the contacts, which come triangle pair by triangle pair, and keeps only the number of pairs.
class PairCounter : public btManifoldResult {
 public:
  PairCounter(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b) : btManifoldResult(a, b) {}

  void addContactPoint(const btVector3&, const btVector3&, btScalar) override {
    if (m_index0 == last_A_ && m_index1 == last_B_) return;
    last_A_ = m_index0;
    last_B_ = m_index1;
    ++pairs;
  }

  std::int64_t pairs = 0;

 private:
  int last_A_ = -1;
  int last_B_ = -1;
};

class BulletQuery : public Query {
 public:
  BulletQuery(const Model& model_A, const Model& model_B) : dispatcher_(&configuration_) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    object_A_.setCollisionShape(dynamic_cast<const BulletModel&>(model_A).shape());
    object_B_.setCollisionShape(dynamic_cast<const BulletModel&>(model_B).shape());
  }

  bool intersects(const Isometry3d& X_AB) override { return count_pairs(X_AB) > 0; }

  std::int64_t count_pairs(const Isometry3d& X_AB) override {
    object_B_.setWorldTransform(transform(X_AB));
    const btCollisionObjectWrapper a(nullptr, object_A_.getCollisionShape(), &object_A_, object_A_.getWorldTransform(),
                                     -1, -1);
    const btCollisionObjectWrapper b(nullptr, object_B_.getCollisionShape(), &object_B_, object_B_.getWorldTransform(),
                                     -1, -1);
    PairCounter counter(&a, &b);
    btCollisionAlgorithm* const algorithm = dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    algorithm->processCollision(&a, &b, btDispatcherInfo(), &counter);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
    return counter.pairs;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btCollisionObject object_A_;
  btCollisionObject object_B_;
};

}  // namespace

Subject bullet_subject() {
  return {.name = "bullet",
          .model = "bullet",
          .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<BulletModel>(mesh); },
          .query = [](const Model& model_A,
                      const Model& model_B) { return std::make_unique<BulletQuery>(model_A, model_B); }};
}

}  // namespace glissade::bench
