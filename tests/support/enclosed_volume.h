#pragma once

/// The volume within a closed mesh.

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::test_support {

/// Cubic metres, positive if triangles face outward. Meaningless for an open mesh.
inline double enclosed_volume(const geometry::TriangleMesh& mesh) {
  double volume = 0;
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
  }
  return volume;
}

}  // namespace glissade::test_support
