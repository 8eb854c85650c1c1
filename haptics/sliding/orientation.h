#pragma once

/// Which side of each triangle of a closed surface is outside, and which points it encloses.

#include <cstdint>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::haptics {

/// For each triangle +1 if its normal, by the order of its corners, points out of what the surface encloses, else −1.
/// Empty for an open surface. Where the triangles have one orientation, it is kept, so that shells inside of others are
/// cavities. Otherwise the triangles of each connected surface get one, and each surface encloses what is inside of it.
/// Cost O(n log n).
std::vector<std::int8_t> outward_signs(const geometry::TriangleMesh& mesh);

/// Whether the surface is closed and encloses p, which is not on it. Cost as above.
bool encloses(const geometry::TriangleMesh& mesh, const Eigen::Vector3d& p);

}  // namespace glissade::haptics
