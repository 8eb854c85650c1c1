#include <cmath>
#include <numbers>

#include <glissade/base/require.h>
#include <glissade/shapes/peg_and_hole.h>

#include "surfaces/loop_mesh.h"

namespace glissade::shapes {

geometry::TriangleMesh make_peg(const PegShape& peg) {
  base::require_positive("radius", peg.radius);
  base::require_positive("length", peg.length);
  base::require_positive("chamfer", peg.chamfer);
  base::require_below("chamfer", peg.chamfer, "the radius", peg.radius);
  base::require_below("chamfer", peg.chamfer, "half the length", peg.length / 2);
  base::require_count("segments", peg.segments, 3, 100'000);
  base::require_count("rows", peg.rows, 1, 100'000);
  const Loop wide = round_loop(peg.radius, peg.segments);
  const Loop narrow = round_loop(peg.radius - peg.chamfer, peg.segments);
  LoopMesh mesh;
  const int bottom = mesh.add_loop(narrow, 0.0);
  const int foot = mesh.add_wall(bottom, wide, 0.0, peg.chamfer, 1);
  const int shoulder = mesh.add_wall(foot, wide, peg.chamfer, peg.length - peg.chamfer, peg.rows);
  const int top = mesh.add_wall(shoulder, narrow, peg.length - peg.chamfer, peg.length, 1);
  mesh.add_cap(bottom, false);
  mesh.add_cap(top, true);
  return mesh.mesh();
}

geometry::TriangleMesh make_holed_plate(const HoledPlateShape& plate) {
  base::require_positive("hole_radius", plate.hole_radius);
  base::require_positive("size", plate.size);
  base::require_positive("thickness", plate.thickness);
  base::require_count("segments", plate.segments, 8, 100'000, 8);
  base::require_count("rows", plate.rows, 1, 100'000);
  const double corner_radius = plate.hole_radius / std::cos(std::numbers::pi / plate.segments);
  base::require_below("the hole's diameter over its corners", 2 * corner_radius, "the size", plate.size);
  const Loop hole = round_loop(plate.hole_radius, plate.segments);
  const Loop outline = polygon_loop(4, plate.size / 2, plate.segments);
  LoopMesh mesh;
  const int lower_outline = mesh.add_loop(outline, -plate.thickness);
  const int upper_outline = mesh.add_wall(lower_outline, outline, -plate.thickness, 0.0, 1);
  const int upper_rim = mesh.add_loop(hole, 0.0);
  mesh.add_band(upper_outline, upper_rim);
  const int lower_rim = mesh.add_wall(upper_rim, hole, 0.0, -plate.thickness, plate.rows);
  mesh.add_band(lower_rim, lower_outline);
  return mesh.mesh();
}

}  // namespace glissade::shapes
