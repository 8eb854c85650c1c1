// ODE: a space of geoms, and in its callback dCollide of two trimeshes as in the other benches. Its sweep-and-prune
// space took half the time of its hash space and its quadtree here, which is small beside the time of the mesh tests.

#include "ode_model.h"
#include "scene_subject.h"

namespace glissade::bench {
namespace {

class OdeScene : public SceneSubject {
 public:
  explicit OdeScene(std::span<const SceneObject> objects)
      : space_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)), numbers_(objects.size()) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      numbers_[i] = i;
      geoms_.push_back(ode_geom(*objects[i].model));
      dGeomSetData(geoms_[i], &numbers_[i]);
      place(geoms_[i], objects[i].X_WO);
      dSpaceAdd(space_, geoms_[i]);
    }
  }
  ~OdeScene() override { dSpaceDestroy(space_); }  // and its geoms
  OdeScene(const OdeScene&) = delete;
  OdeScene& operator=(const OdeScene&) = delete;

  void step(std::span<const MovedObject> moved) override {
    meeting_.clear();
    for (const MovedObject& object : moved)
      place(geoms_[object.object], object.X_WO);
    dSpaceCollide(space_, this,
                  [](void* scene, dGeomID a, dGeomID b) { static_cast<OdeScene*>(scene)->look_at(a, b); });
  }

  std::vector<NumberPair> meeting() const override { return meeting_; }

 private:
  static std::size_t number_of(dGeomID geom) { return *static_cast<const std::size_t*>(dGeomGetData(geom)); }

  void look_at(dGeomID a, dGeomID b) {
    dContactGeom contact;
    if (dCollide(a, b, static_cast<int>(CONTACTS_UNIMPORTANT | 1U), &contact, sizeof(dContactGeom)) > 0)
      meeting_.emplace_back(number_of(a), number_of(b));
  }

  dSpaceID space_;
  std::vector<std::size_t> numbers_;
  std::vector<dGeomID> geoms_;
  std::vector<NumberPair> meeting_;
};

}  // namespace

SceneLibrary ode_scenes() {
  return {.name = "ode",
          .model = "ode",
          .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<OdeModel>(mesh); },
          .start = [](std::span<const SceneObject> objects) { return std::make_unique<OdeScene>(objects); }};
}

}  // namespace glissade::bench
