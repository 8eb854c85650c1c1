// Bullet: its dynamic trees of boxes, and GImpact for their pairs, as in the other benches. The other work of a
// collision world, keeping contacts from frame to frame, is left out.

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <btBulletCollisionCommon.h>

#include "bullet_model.h"
#include "scene_subject.h"

namespace glissade::bench {
namespace {

// Records only whether there is a contact.
class ContactFlag : public btManifoldResult {
 public:
  using btManifoldResult::btManifoldResult;
  void addContactPoint(const btVector3&, const btVector3&, btScalar) override { touch = true; }

  bool touch = false;
};

btCollisionObjectWrapper wrapper(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

class BulletScene : public SceneSubject {
 public:
  explicit BulletScene(std::span<const SceneObject> objects) : dispatcher_(&configuration_), objects_(objects.size()) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      btCollisionObject& object = objects_[i];
      object.setCollisionShape(dynamic_cast<const BulletModel&>(*objects[i].model).shape());
      object.setWorldTransform(transform(objects[i].X_WO));
      object.setUserIndex(static_cast<int>(i));
      const Box box = box_of(object);
      object.setBroadphaseHandle(broad_phase_.createProxy(box.low, box.high, object.getCollisionShape()->getShapeType(),
                                                          &object, btBroadphaseProxy::DefaultFilter,
                                                          btBroadphaseProxy::AllFilter, &dispatcher_));
    }
  }
  ~BulletScene() override {
    for (btCollisionObject& object : objects_)
      broad_phase_.destroyProxy(object.getBroadphaseHandle(), &dispatcher_);
  }
  BulletScene(const BulletScene&) = delete;
  BulletScene& operator=(const BulletScene&) = delete;

  void step(std::span<const MovedObject> moved) override {
    meeting_.clear();
    for (const MovedObject& moved_object : moved) {
      btCollisionObject& object = objects_[moved_object.object];
      object.setWorldTransform(transform(moved_object.X_WO));
      const Box box = box_of(object);
      broad_phase_.setAabb(object.getBroadphaseHandle(), box.low, box.high, &dispatcher_);
    }
    broad_phase_.calculateOverlappingPairs(&dispatcher_);
    btBroadphasePairArray& pairs = broad_phase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i)
      look_at(pairs[i]);
  }

  std::vector<NumberPair> meeting() const override { return meeting_; }

 private:
  struct Box {
    btVector3 low;
    btVector3 high;
  };

  static Box box_of(const btCollisionObject& object) {
    Box box;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), box.low, box.high);
    return box;
  }

  // The broad phase keeps the algorithm of a pair for as long as the pair lasts.
  void look_at(btBroadphasePair& pair) {
    const auto& a = *static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject);
    const auto& b = *static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
    const btCollisionObjectWrapper wrapper_A = wrapper(a);
    const btCollisionObjectWrapper wrapper_B = wrapper(b);
    if (pair.m_algorithm == nullptr)
      pair.m_algorithm = dispatcher_.findAlgorithm(&wrapper_A, &wrapper_B, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    ContactFlag result(&wrapper_A, &wrapper_B);
    pair.m_algorithm->processCollision(&wrapper_A, &wrapper_B, btDispatcherInfo(), &result);
    if (result.touch)
      meeting_.emplace_back(static_cast<std::size_t>(a.getUserIndex()), static_cast<std::size_t>(b.getUserIndex()));
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  std::vector<btCollisionObject> objects_;
  std::vector<NumberPair> meeting_;
};

}  // namespace

SceneLibrary bullet_scenes() {
  return {.name = "bullet",
          .model = "bullet",
          .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<BulletModel>(mesh); },
          .start = [](std::span<const SceneObject> objects) { return std::make_unique<BulletScene>(objects); }};
}

}  // namespace glissade::bench
