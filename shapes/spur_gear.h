#pragma once

/// A spur gear with a bore, and a base with a post. The base is the gear's flat seat, and the post guides the bore.
///
/// Teeth are involutes. They are 1 module high above the pitch circle, and 1.25 modules deep below this circle. Below
/// the base circle the flanks are straight down to the root. Radii of bore and post are those of inscribed circles, as
/// in `peg_and_hole.h`. The corners of the post lie farther out by the factor 1 / cos(π / segments). The gear turns
/// freely if the bore's radius exceeds the radius of these corners. Meshes are closed, face outward, and have no
/// triangle without area.
///
/// Sizes are in metres. The functions throw std::invalid_argument, naming the argument and its value, if a size is not
/// positive and finite, if sizes do not fit together, or if a count is out of range.

#include <numbers>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

struct GearShape {
  int teeth = 24;               ///< number of teeth, 8 ... 1000
  double module = 1e-3;         ///< pitch diameter per tooth
  double width = 10e-3;         ///< width along z
  double bore_radius = 5.5e-3;  ///< less than 0.8 · root radius, which is module · (teeth / 2 - 1.25)
  double pressure_angle = 20 * std::numbers::pi / 180;  ///< radians, between 0.2 and 0.5
  int flank_points = 5;                                 ///< points on each flank of a tooth, 2 ... 1000
  int rows = 1;                                         ///< cells along the width, 1 ... 10,000
};

/// Gear about z from z = 0 to z = width. The middle of a tooth is on the x axis. The bore has two facets for each
/// tooth. The gear has 4 · teeth · (flank_points + 1) · (rows + 1) triangles or, if the root circle lies within the
/// base circle, 4 · teeth · (flank_points + 2) · (rows + 1).
geometry::TriangleMesh make_spur_gear(const GearShape& gear);

struct GearBaseShape {
  double size = 40e-3;      ///< edge of the square base
  double thickness = 5e-3;  ///< thickness of the base
  double post_radius = 5e-3;
  double post_height = 15e-3;
  double chamfer = 1e-3;  ///< 45° chamfer at the end of the post; less than the post's radius and height
  int segments = 64;      ///< facets around the post, a multiple of 8 up to 100,000
};

/// Base with a post. The upper face of the base, the seat, is at z = 0. The post is about z on the seat. The mesh has
/// 10 · segments triangles.
geometry::TriangleMesh make_gear_base(const GearBaseShape& base);

}  // namespace glissade::shapes
