#include <glissade/collision/dop.h>

namespace glissade::collision {

Eigen::Vector3d dop_direction(int half_space) {
  const auto& direction = kSlabDirections[static_cast<std::size_t>(half_space % kDopSlabs)];
  const Eigen::Vector3d b(direction[0], direction[1], direction[2]);
  return half_space < kDopSlabs ? b : -b;
}

}  // namespace glissade::collision
