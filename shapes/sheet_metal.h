#pragma once

/// Sheet metal as a surface without thickness, made of a flat blank with punched holes and pressed beads. The mesh is
/// welded and conforming, and its edges follow the outlines of holes and beads.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// An outline in the plane of the sheet, with sides parallel to the axes, in metres. A circle has size (d, d) and
/// corner_radius d/2.
struct RoundedRectangle {
  Eigen::Vector2d center;
  Eigen::Vector2d size;
  double corner_radius;
};

/// Signed distance (metres) of `point` from the outline. It is negative inside.
double signed_distance(const RoundedRectangle& outline, const Eigen::Vector2d& point);

/// A plateau within `foot`, raised if height > 0 and sunk if height < 0. The flank of the plateau rises linearly over
/// `flank_width`. Outside the foot the sheet stays exactly flat.
struct Bead {
  RoundedRectangle foot;
  double height;
  double flank_width;
};

/// The blank is a rectangle about the origin in the plane z = 0. A corner_radius of 0 gives sharp corners.
struct SheetMetal {
  Eigen::Vector2d size;
  double corner_radius = 0;
  std::vector<RoundedRectangle> holes;
  std::vector<Bead> beads;
};

/// The sheet with about `triangle_count` triangles, facing +z. If `triangle_count` is too small for the shapes of holes
/// and beads, the mesh has more triangles. Vertices on an outline are within 1e-7 m of the exact outline.
///
/// Throws std::invalid_argument in these cases: a size is not positive; a corner radius does not fit; a flank is wider
/// than the bead allows; or a hole or bead is not within the sheet. Holes and beads should not overlap. If they do, a
/// hole takes precedence over a bead, and a later bead over an earlier bead.
geometry::TriangleMesh make_sheet(const SheetMetal& sheet, std::int64_t triangle_count);

}  // namespace glissade::shapes
