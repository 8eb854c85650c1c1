// FCL: a dynamic tree of boxes over the objects, and the test of two meshes that the other benches use, in its
// callback.
// update() of the whole tree takes half the time of update() with a list of all objects, and no longer than with the
// same tree in an array; all of these are small beside the time of the mesh tests.

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>

#include "fcl_model.h"
#include "scene_subject.h"

namespace glissade::bench {
namespace {

using FclObject = fcl::CollisionObject<double>;

struct FclSceneModel : Model {
  explicit FclSceneModel(const geometry::TriangleMesh& mesh) : tree(std::make_shared<FclTree>(fcl_tree(mesh))) {}
  std::shared_ptr<FclTree> tree;
};

class FclScene : public SceneSubject {
 public:
  explicit FclScene(std::span<const SceneObject> objects) : numbers_(objects.size()) {
    std::vector<FclObject*> all;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const auto& model = dynamic_cast<const FclSceneModel&>(*objects[i].model);
      objects_.push_back(std::make_unique<FclObject>(model.tree, objects[i].X_WO));
      numbers_[i] = i;
      objects_[i]->setUserData(&numbers_[i]);
      all.push_back(objects_[i].get());
    }
    manager_.registerObjects(all);
    manager_.setup();
  }

  void step(std::span<const MovedObject> moved) override {
    meeting_.clear();
    for (const MovedObject& object : moved) {
      objects_[object.object]->setTransform(object.X_WO);
      objects_[object.object]->computeAABB();
    }
    manager_.update();
    manager_.collide(this, [](FclObject* a, FclObject* b, void* scene) {
      static_cast<FclScene*>(scene)->look_at(*a, *b);
      return false;  // go on
    });
  }

  std::vector<NumberPair> meeting() const override { return meeting_; }

 private:
  static std::size_t number_of(const FclObject& object) {
    return *static_cast<const std::size_t*>(object.getUserData());
  }

  void look_at(const FclObject& a, const FclObject& b) {
    result_.clear();
    if (fcl::collide(&a, &b, request_, result_) > 0) meeting_.emplace_back(number_of(a), number_of(b));
  }

  std::vector<std::size_t> numbers_;
  std::vector<std::unique_ptr<FclObject>> objects_;
  fcl::DynamicAABBTreeCollisionManager<double> manager_;
  const fcl::CollisionRequest<double> request_{1};
  fcl::CollisionResult<double> result_;
  std::vector<NumberPair> meeting_;
};

}  // namespace

SceneLibrary fcl_scenes() {
  return {.name = "fcl",
          .model = "fcl",
          .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<FclSceneModel>(mesh); },
          .start = [](std::span<const SceneObject> objects) { return std::make_unique<FclScene>(objects); }};
}

}  // namespace glissade::bench
