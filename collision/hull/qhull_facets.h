#pragma once

/// Convex hulls in two or three dimensions by Qhull, which is C and wants its memory back.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace glissade::collision {

/// Facets are segments in two dimensions and triangles in three; the last index of a segment is −1.
struct HullFacets {
  std::vector<std::array<std::int32_t, 3>> facets;  ///< indices of points
  double thickness = 0.0;  ///< a point may lie so far outside of the facets' corners' hull, at most
  double altitude = 0.0;   ///< the least distance of a corner of a facet from the opposite side
};

/// The hull of points of `dimension` (2 or 3) coordinates each, one after the other, about as large as 1. Empty when
/// Qhull finds them too flat.
HullFacets qhull_facets(std::span<double> coordinates, int dimension);

}  // namespace glissade::collision
