#pragma once

/// A round peg and a plate with a hole, for measurements of sliding contact in a narrow fit. Both have the flat facets
/// of a tessellation.
///
/// Radii are those of the inscribed circle, which touches all facets. Corners lie farther out by the factor 1 / cos(π /
/// segments). Let peg and hole have equally many segments and be coaxial. If the peg is not turned, the facets are
/// parallel, and the gap is exactly the difference of the radii. If the peg is turned by half a facet, its corners face
/// the facets of the hole. The gap is then smaller by radius · (1 / cos(π / segments) - 1), for example by 5 µm for a
/// radius of 4 mm and 64 segments.
///
/// Meshes are closed, face outward, and have no triangle without area.
///
/// Sizes are in metres. The functions throw std::invalid_argument, naming the argument and its value, if a size is not
/// positive and finite, if sizes do not fit together, or if a count is out of range.

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

struct PegShape {
  double radius = 4e-3;
  double length = 50e-3;
  double chamfer = 0.5e-3;  ///< 45° chamfer at both ends; less than the radius and than half the length
  int segments = 64;        ///< facets around, 3 ... 100,000
  int rows = 1;             ///< cells along the straight wall, 1 ... 100,000
};

/// Peg about z from z = 0 to z = length. The mesh has 2 · segments · (rows + 3) triangles.
geometry::TriangleMesh make_peg(const PegShape& peg);

struct HoledPlateShape {
  double hole_radius = 4.052e-3;
  double size = 40e-3;      ///< edge of the square plate; more than the diameter of the hole over its corners
  double thickness = 9e-3;  ///< the depth of the hole
  int segments = 64;        ///< facets around the hole, a multiple of 8 up to 100,000
  int rows = 1;             ///< cells along the wall of the hole, 1 ... 100,000
};

/// Square plate about z with its upper face at z = 0 and a through hole about z with sharp rims.
/// The mesh has 2 · segments · (rows + 3) triangles.
geometry::TriangleMesh make_holed_plate(const HoledPlateShape& plate);

}  // namespace glissade::shapes
