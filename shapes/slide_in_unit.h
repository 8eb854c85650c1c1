#pragma once

/// A unit that slides into a bay, such as a radio into its slot. Spring tongues of the bay overlap the unit by design.
/// The shapes test whether a part reaches its seat although other objects are in its way.
///
/// The unit is given in its own frame. When the unit is seated, this frame coincides with the frame of the bay. The
/// unit slides in along +y. The bezel lies between y = -bezel_thickness and y = 0. When the unit is seated, the back of
/// the bezel touches the flange of the bay in the plane y = 0 at a distance of exactly zero. The body reaches from y =
/// 0 to y = depth, with `clearance` to the bay on all sides and at the back. The tongues stand on the walls x = ±
/// (width / 2 + clearance) and reach into the sides of the body by `overlap`.
///
/// Sizes are in metres. The functions throw std::invalid_argument, naming the argument and its value, if a size is not
/// positive and finite, if sizes do not fit together, or if a count is out of range.

#include <cstdint>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

struct SlideInShape {
  double width = 0.18;   ///< width of the body, along x
  double height = 0.05;  ///< height of the body, along z
  double depth = 0.16;   ///< depth of the body, along y
  double bezel_thickness = 8e-3;
  double bezel_border = 6e-3;  ///< width of bezel and flange beyond the body; more than the clearance
  double clearance = 0.5e-3;
  double overlap = 0.3e-3;        ///< overlap of each tongue with the seated body; less than half the width
  int tongues_per_side = 2;       ///< tongues on each side, one behind the other, 1 ... 100
  std::int64_t triangles = 1000;  ///< approximate number for the unit, and also for the bay without tongues
};

/// The unit, with body and bezel as two closed components.
geometry::TriangleMesh make_slide_in_unit(const SlideInShape& shape);

/// The bay without its tongues, with walls, back and flange as open sheets.
geometry::TriangleMesh make_bay(const SlideInShape& shape);

/// The tongues, i.e. open sheets that rise from their wall and return to it. Each tongue has a mesh of its own. The
/// tongues at x < 0 come first, then those at x > 0, each group from front to back.
std::vector<geometry::TriangleMesh> make_bay_tongues(const SlideInShape& shape);

/// A bay with its tongues as one mesh, and the ascending triangle numbers of the tongues.
struct BayWithTongues {
  geometry::TriangleMesh mesh;
  std::vector<std::int32_t> tongue_triangles;
};
BayWithTongues make_bay_with_tongues(const SlideInShape& shape);

}  // namespace glissade::shapes
