#include "scene_cast.h"

#include <algorithm>
#include <utility>

#include "suite.h"

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

SceneCast::SceneCast() {
  for (const std::int64_t triangles : {1'000, 5'000, 20'000}) {
    for (geometry::TriangleMesh& mesh : all_shapes(triangles, kObjectSize_m)) {
      radii_.push_back(radius_of(mesh));
      meshes_.push_back(std::move(mesh));
    }
  }
}

std::unique_ptr<SceneSubject> SceneCast::start(const SceneLibrary& library, const Scene& scene) {
  std::vector<std::unique_ptr<Model>>& models = models_[library.model];
  for (std::size_t i = models.size(); i < meshes_.size(); ++i)
    models.push_back(library.build(meshes_[i]));
  std::vector<SceneObject> objects;
  for (const MovedObject& object : first_frame(scene))
    objects.push_back({models[scene[object.object].model].get(), object.X_WO});
  return library.start(objects);
}

}  // namespace glissade::bench
