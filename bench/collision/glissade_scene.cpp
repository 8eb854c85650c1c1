// Glissade: a world with a tree and a hull for each mesh, and the collision pipeline.

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/convex_hull.h>

#include "scene_subject.h"

namespace glissade::bench {
namespace {

using collision::ObjectId;
using collision::ObjectPair;

struct GlissadeSceneModel : Model {
  explicit GlissadeSceneModel(const geometry::TriangleMesh& mesh)
      : tree(std::make_shared<const collision::DopTree>(std::make_shared<const geometry::TriangleMesh>(mesh))),
        hull(std::make_shared<const collision::ConvexHull>(mesh)) {}

  std::shared_ptr<const collision::DopTree> tree;
  std::shared_ptr<const collision::ConvexHull> hull;
};

class GlissadeScene : public SceneSubject {
 public:
  GlissadeScene(std::span<const SceneObject> objects, int threads)
      : world_(static_cast<int>(objects.size())),
        pipeline_(world_, clock_, {.threads = threads}),
        number_of_slot_(objects.size()) {
    for (const SceneObject& object : objects) {
      const auto& model = dynamic_cast<const GlissadeSceneModel&>(*object.model);
      const ObjectId id = world_.add({.tree = model.tree, .hull = model.hull, .X_WO = object.X_WO});
      number_of_slot_[id.index] = ids_.size();
      ids_.push_back(id);
    }
  }

  void step(std::span<const MovedObject> moved) override {
    for (const MovedObject& object : moved)
      world_.move(ids_[object.object], object.X_WO);
    pipeline_.step();
  }

  std::vector<NumberPair> meeting() const override {
    std::vector<NumberPair> pairs;
    for (const ObjectPair& pair : pipeline_.result().meeting)
      pairs.emplace_back(number_of_slot_[pair.object_A.index], number_of_slot_[pair.object_B.index]);
    return pairs;
  }

  const collision::FrameReport* report() const override { return &pipeline_.result().report; }

 private:
  collision::World world_;
  realtime::SteadyClock clock_;
  collision::CollisionPipeline pipeline_;
  std::vector<ObjectId> ids_;
  std::vector<std::size_t> number_of_slot_;
};

}  // namespace

SceneLibrary glissade_scenes(int threads) {
  return {
      .name = threads == 1 ? "glissade" : "glissade-" + std::to_string(threads) + "-threads",
      .model = "glissade",
      .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<GlissadeSceneModel>(mesh); },
      .start = [threads](
                   std::span<const SceneObject> objects) { return std::make_unique<GlissadeScene>(objects, threads); }};
}

}  // namespace glissade::bench
