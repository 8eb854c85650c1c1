#pragma once

/// Sheet metal as surfaces without thickness: a flat blank with holes punched and beads pressed into it.
/// One welded, conforming mesh whose edges follow the outlines of holes and beads.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// An outline in the plane of the sheet, along its axes. Circle: size (d, d), corner_radius d/2. Metres.
struct RoundedRectangle {
  Eigen::Vector2d center;
  Eigen::Vector2d size;
  double corner_radius;
};

/// Signed distance in metres of `point` from the outline, negative inside.
double signed_distance(const RoundedRectangle& outline, const Eigen::Vector2d& point);

/// A raised (height > 0) or sunk (height < 0) plateau within `foot`; its flank rises linearly over `flank_width`.
/// Outside the foot the sheet stays exactly flat.
struct Bead {
  RoundedRectangle foot;
  double height;
  double flank_width;
};

/// The blank is a rectangle about the origin in the plane z = 0 with rounded corners (0 for sharp ones).
struct SheetMetal {
  Eigen::Vector2d size;
  double corner_radius = 0;
  std::vector<RoundedRectangle> holes;
  std::vector<Bead> beads;
};

/// The sheet with about `triangle_count` triangles, facing +z. Holes and beads keep their shape at any count: the mesh
/// around them is never coarser than they require, so very small counts are exceeded. Vertices of outlines lie on them
/// within 1e-7 m.
///
/// Throws std::invalid_argument for a size that is not positive, a corner radius that does not fit, a flank wider than
/// the bead allows, or a hole or bead that is not within the sheet. Holes and beads should not overlap: where a
/// hole and a bead do, the hole wins; where two beads do, the later one.
geometry::TriangleMesh make_sheet(const SheetMetal& sheet, std::int64_t triangle_count);

}  // namespace glissade::shapes
