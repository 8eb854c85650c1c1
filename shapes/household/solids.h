#pragma once

/// Solids with rounded edges as closed, welded meshes: bodies of revolution, plates, and sweeps along curves. Lengths
/// in metres. `edge` is the longest edge of cells along round surfaces.

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

#include "surfaces/patch_solids.h"

namespace glissade::shapes {

/// The same corners in metres, for coordinates and radii in millimetres.
std::vector<Corner> in_mm(std::vector<Corner> corners);

/// Points in space; all loops of a loft have equally many.
using SpaceLoop = std::vector<Eigen::Vector3d>;

/// The surface through loops that run counterclockwise seen from the next one. A ring is joined from its last loop to
/// its first; otherwise fans about the middles of the end loops close it.
geometry::TriangleMesh loft(const std::vector<SpaceLoop>& loops, bool is_ring);

/// The body of revolution about z within a profile (r, z) that runs from the axis outwards, upwards and back to the
/// axis.
geometry::TriangleMesh turned_solid(const std::vector<Corner>& profile, double edge);

/// The plate |z| <= thickness / 2 within an outline, which must be star-shaped about the origin. The rims of both faces
/// are rounded, by at most half the thickness.
geometry::TriangleMesh plate_solid(const PlaneCurve& outline, double thickness, double rounding, double edge);

/// A section that moves along a smooth path from t = 0 to 1.
struct Sweep {
  std::function<Eigen::Vector3d(double t)> path;
  /// Half the extent of the section along up × tangent, and along `up`.
  std::function<Eigen::Vector2d(double t)> half_size;
  Eigen::Vector3d up;    ///< across the path everywhere
  double power = 2.0;    ///< 2: an ellipse; the larger, the nearer to a rectangle
  double dome = 0.0;     ///< height of the rounded ends, in half extents along `up`; 0: flat ends
  bool is_ring = false;  ///< the path ends where it begins
};
std::vector<SpaceLoop> swept_loops(const Sweep& sweep, double edge);
geometry::TriangleMesh swept_solid(const Sweep& sweep, double edge);

/// A cubic Bézier curve, its points in millimetres.
std::function<Eigen::Vector3d(double t)> bezier_mm(const std::vector<Eigen::Vector3d>& points);

/// Adds a component to a mesh.
void add(geometry::TriangleMesh& mesh, const geometry::TriangleMesh& part,
         const Eigen::Isometry3d& X = Eigen::Isometry3d::Identity());

}  // namespace glissade::shapes
