#pragma once

/// The vector code of the contact search: eight corners of triangles over the faces of others at once, with the same
/// bits as `closest_on_triangle` gives for one.

#include <array>
#include <cstddef>

namespace glissade::contact {

inline constexpr std::size_t kCornersAtOnce = 8;

/// A number for each corner.
using NumbersOfCorners = std::array<double, kCornersAtOnce>;
/// A vector for each corner: [axis][corner], metres.
using VectorsOfCorners = std::array<NumbersOfCorners, 3>;

/// Corners, and the triangles over which they may be. Entries that are not used may have any values.
struct alignas(64) CornersOverTriangles {
  VectorsOfCorners x;
  std::array<VectorsOfCorners, 3> triangle;  ///< [its corner]
  std::array<NumbersOfCorners, 3> is_rim;    ///< 1 for an edge of the triangle that is not flat, else 0
  NumbersOfCorners is_of_obstacle;           ///< 1 for a corner of the obstacle over a triangle of the part, else 0
};

/// Where the point of its triangle that is closest to a corner lies inside the face: this point, and more of the
/// contact. Elsewhere all but `is_inside` has no meaning.
struct alignas(64) CornersOverFaces {
  NumbersOfCorners is_inside;  ///< 1 or 0
  VectorsOfCorners point;
  NumbersOfCorners gap;      ///< metres
  VectorsOfCorners n;        ///< unit, from obstacle to part; no numbers if the gap is 0
  NumbersOfCorners to_rims;  ///< metres from the point to the nearest line of an edge that is not flat, or infinite
};

/// Thread-safe.
void find_corners_over_faces(const CornersOverTriangles& corners, CornersOverFaces& over);

}  // namespace glissade::contact
