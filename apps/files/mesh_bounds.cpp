#include <glissade/apps/files/mesh_bounds.h>

namespace glissade::apps {

Eigen::AlignedBox3d bounds_of(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    bounds.extend(vertex);
  return bounds;
}

}  // namespace glissade::apps
