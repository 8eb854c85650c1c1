#pragma once

/// Parts in their places at nominal size, as assemblies straight from CAD have them: faces coincide, and nothing
/// overlaps.

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::test_support {

/// All in the frame of the assembly, metres.
struct NominalFit {
  std::string name;
  /// The part with all faces moved inwards by so much; outwards if it is negative. An open part moves as a whole.
  std::function<geometry::TriangleMesh(double inwards)> part;
  std::vector<geometry::TriangleMesh> others;
  Eigen::Vector3d way_out;               ///< a translation that nothing blocks
  std::vector<Eigen::Vector3d> blocked;  ///< directions
};

/// Sleeve, slab, box on a table, dovetail, key, bearing, stacked plates, coaxial tubes, sheets and others.
const std::vector<NominalFit>& nominal_fits();

}  // namespace glissade::test_support
