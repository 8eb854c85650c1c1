#pragma once

/// Triangulation of the polygons in mesh files.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "io/mesh_readers.h"

namespace glissade::geometry {

/// Largest number of corners: larger polygons are refused, because the time to triangulate grows with the square of
/// this number.
inline constexpr std::size_t kMostCorners = 5000;

/// Triangulates the polygon through `points` by ear clipping, into points.size() - 2 triangles. Triangles are given by
/// indices into `points` and oriented as the polygon is. A plane concave polygon is covered exactly. Of a polygon that
/// crosses itself or leaves its plane, an arbitrary triangulation is returned. Cost
/// O(n²) for ordinary polygons.
std::vector<std::array<std::size_t, 3>> triangulated(std::span<const Eigen::Vector3d> points);

/// Adds the triangles of a polygon of at least three corners, given by their vertices, to the soup. Throws
/// std::invalid_argument when the soup would have more than 2^31 - 1 triangles.
void add_polygon(const MeshFile& file, std::span<const std::int32_t> corners, TriangleSoup& soup);

}  // namespace glissade::geometry
