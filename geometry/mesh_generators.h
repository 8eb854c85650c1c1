#pragma once

/// Triangle meshes of simple surfaces, for tests, benchmarks and scenes.
///
/// Sizes are in metres. The result has only approximately `triangle_count` triangles, because the faces are grids with
/// whole numbers of rows and columns. If `triangle_count` is at least 200 and the shape is neither flat nor slender,
/// the number of triangles deviates from `triangle_count` by at most 25 %. All vertices lie on the surface, and
/// adjacent triangles share vertices. Triangles are oriented consistently. The triangles of closed surfaces face
/// outward (exception: see `make_revolution`). Every function except `make_revolution` throws std::invalid_argument for
/// a size that is not positive and finite, or a count outside 1 ... 50,000,000. The message has the argument and value.

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Sphere about the origin, tessellated along parallels and meridians about z.
GLISSADE_EXPORT TriangleMesh make_sphere(double radius, std::int64_t triangle_count);

/// Torus about z: a tube of radius `minor_radius` around a circle of radius `major_radius` > `minor_radius`.
GLISSADE_EXPORT TriangleMesh make_torus(double major_radius, double minor_radius, std::int64_t triangle_count);

/// Hyperboloid of one sheet about z, open at both ends. The radius is `waist_radius` at z = 0, and `rim_radius` at z =
/// ± height/2. `rim_radius` must be greater than `waist_radius`.
GLISSADE_EXPORT TriangleMesh make_hyperboloid(double waist_radius, double rim_radius, double height,
                                              std::int64_t triangle_count);

/// Box about the origin with edge lengths `size`. Each face is a grid of nearly square cells.
GLISSADE_EXPORT TriangleMesh make_box(const Eigen::Vector3d& size, std::int64_t triangle_count);

/// Flat open sheet without thickness in the plane z = 0, about the origin, facing +z.
GLISSADE_EXPORT TriangleMesh make_plate(const Eigen::Vector2d& size, std::int64_t triangle_count);

/// Cylindrical shell about z, without thickness, open at both ends z = ± length/2.
GLISSADE_EXPORT TriangleMesh make_tube(double radius, double length, std::int64_t triangle_count);

/// Shell of circular cross-section without thickness, open at both ends. The cross-section is swept along the smooth
/// curve (Catmull-Rom spline) through `points`. There must be at least two points, and successive points must differ.
/// Where the curve bends too tightly, the shell may intersect itself. The function does not check this.
GLISSADE_EXPORT TriangleMesh make_hose(std::span<const Eigen::Vector3d> points, double radius,
                                       std::int64_t triangle_count);

/// Surface of revolution. The polyline through `profile` is revolved about z in `segments` ≥ 3 steps. The profile has
/// at least two points (r, z) with r ≥ 0. An end of the profile on the axis (r = 0) closes the surface there. If
/// `closed` is true, a last segment joins the last point to the first. Triangles face away from the axis where z
/// increases along the profile. In a drawing with r to the right and z up, triangles face to the right of the profile's
/// direction.
GLISSADE_EXPORT TriangleMesh make_revolution(std::span<const Eigen::Vector2d> profile, bool closed, int segments);

}  // namespace glissade::geometry
