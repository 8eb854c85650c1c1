#include "scene_cast.h"

#include <algorithm>
#include <utility>

namespace glissade::bench {
namespace {

constexpr double kObjectSize_m = 0.1;

double radius_of(const geometry::TriangleMesh& mesh) {
  double radius = 0.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    radius = std::max(radius, vertex.norm());
  return radius;
}

}  // namespace

SceneCast::SceneCast(std::vector<SceneLibrary> libraries, const BenchOptions& options)
    : libraries_(std::move(libraries)) {
  for (const SuiteMesh& suite_mesh : suite_meshes(options.suite, options.suite.scene_triangles, kObjectSize_m)) {
    const geometry::TriangleMesh mesh = suite_mesh.make();
    radii_.push_back(radius_of(mesh));
    for (const SceneLibrary& library : libraries_) {
      std::vector<std::unique_ptr<Model>>& models = models_[library.model];
      if (models.size() < radii_.size()) models.push_back(library.build(mesh));
    }
  }
}

std::vector<std::unique_ptr<SceneSubject>> SceneCast::start(const Scene& scene) const {
  std::vector<std::unique_ptr<SceneSubject>> subjects;
  for (const SceneLibrary& library : libraries_) {
    const std::vector<std::unique_ptr<Model>>& models = models_.at(library.model);
    std::vector<SceneObject> objects;
    for (const MovedObject& object : first_frame(scene))
      objects.push_back({models[scene[object.object].model].get(), object.X_WO});
    subjects.push_back(library.start(objects));
  }
  return subjects;
}

}  // namespace glissade::bench
