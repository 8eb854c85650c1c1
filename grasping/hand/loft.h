#pragma once

/// Smooth closed meshes: elliptic sections across the x axis, strung along it, closed by round caps.

#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::grasping {

/// A section at `x`: a superellipse about (y, z), which reaches `width` to both sides in y, `up` in +z, `down` in −z.
struct LoftSection {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double width = 0.0;
  double up = 0.0;
  double down = 0.0;
};

/// The sections, in the order of x, covered by triangles that face outward. Before the first and after the last
/// section, a half ellipsoid of that length closes the mesh. `corner` is the exponent of the superellipses: 2 gives
/// ellipses, larger exponents fuller sections. `around` triangles meet at each end. All measures in metres.
geometry::TriangleMesh loft(const std::vector<LoftSection>& sections, double start_cap, double end_cap, double corner,
                            int around);

}  // namespace glissade::grasping
