#pragma once

/// Polygons of mesh files into triangles.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace glissade::geometry {

/// The time to cut a polygon grows with the square of its corners, so larger ones are refused.
inline constexpr std::size_t kMostCorners = 5000;

/// Cuts the polygon through `points` into points.size() - 2 triangles, given by positions within `points`, oriented as
/// the polygon is. Concave polygons are covered exactly; for those that cross or leave their plane any cut will do. The
/// importer library's own triangulation covers some concave polygons twice. Cost O(n²) for ordinary polygons.
std::vector<std::array<std::size_t, 3>> triangulated(std::span<const Eigen::Vector3d> points);

}  // namespace glissade::geometry
