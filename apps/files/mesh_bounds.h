#pragma once

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// The box (metres) round all vertices of a mesh, along the axes of its frame.
Eigen::AlignedBox3d bounds_of(const geometry::TriangleMesh& mesh);

}  // namespace glissade::apps
