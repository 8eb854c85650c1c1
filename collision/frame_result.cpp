#include <glissade/collision/frame_result.h>

namespace glissade::collision {

Eigen::Isometry3d relative_pose(const WorldObject& object_A, const WorldObject& object_B) {
  return object_A.X_WO.inverse(Eigen::Isometry) * object_B.X_WO;
}

}  // namespace glissade::collision
