#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

/// The corners of a triangle, in the frame of its mesh.
inline geometry::TrianglePoints points_of(const geometry::TriangleMesh& mesh, std::int32_t triangle) {
  return mesh.corners(triangle);
}

/// The same in a frame in which the mesh is at X.
inline geometry::TrianglePoints points_of(const geometry::TriangleMesh& mesh, std::int32_t triangle,
                                          const Eigen::Isometry3d& X) {
  return {X * mesh.corner(triangle, 0), X * mesh.corner(triangle, 1), X * mesh.corner(triangle, 2)};
}

}  // namespace glissade::test_support
