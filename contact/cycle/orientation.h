#pragma once

/// Which side of each triangle of a closed surface is outside, and which points it encloses.

#include <cstdint>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::contact {

/// For each triangle +1 if its normal, by the order of its corners, points out of what the surface encloses, else −1.
/// Empty for an open surface. A connected surface inside of no other encloses what is
/// inside of it. Where the triangles of all surfaces have one orientation each, those inside of others keep theirs
/// relative to the outermost: they are cavities or solids. Otherwise they are solids. Cost O(n log n), and O(n) more
/// for each connected surface that lies in the bounding box of another.
std::vector<std::int8_t> outward_signs(const geometry::TriangleMesh& mesh);

/// Whether the surface is closed and encloses p, which is not on it. Cost as above.
bool encloses(const geometry::TriangleMesh& mesh, const Eigen::Vector3d& p);

}  // namespace glissade::contact
