#pragma once

/// Convex hulls in two or three dimensions, by the C interface of Qhull.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace glissade::collision {

/// Facets are segments in two dimensions and triangles in three; the last index of a segment is −1.
struct HullFacets {
  std::vector<std::array<std::int32_t, 3>> facets;  ///< indices of points
  double thickness = 0.0;  ///< bound on the distance of a point outside of the hull of the facets' corners
  double altitude = 0.0;   ///< the least distance of a corner of a facet from the opposite side
};

/// The hull of points with `dimension` (2 or 3) coordinates each, stored one point after another, with an extent of
/// about 1. Empty if the points are too flat for Qhull.
HullFacets qhull_facets(std::span<double> coordinates, int dimension);

}  // namespace glissade::collision
