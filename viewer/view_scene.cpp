#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

Eigen::Vector3d ViewScene::p_WO() const {
  if (p_WO_chosen) return *p_WO_chosen;
  Eigen::AlignedBox3d bounds_W;
  for (const ViewObject& object : objects) {
    const Eigen::AlignedBox3d bounds_B = geometry::bounds_of(*object.mesh);
    if (!bounds_B.isEmpty()) bounds_W.extend(object.X_WB * bounds_B.center());
  }
  return bounds_W.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(bounds_W.center());
}

std::size_t ViewScene::triangles() const {
  std::size_t count = 0;
  for (const ViewObject& object : objects)
    count += object.mesh->triangles.size();
  return count;
}

}  // namespace glissade::viewer
