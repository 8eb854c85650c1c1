#pragma once

/// Triangle meshes of simple surfaces, for tests, benchmarks and scenes.
///
/// Sizes are in metres. `triangle_count` asks for about so many triangles; the result is the nearest even tessellation,
/// within a quarter of the request from 200 triangles on. All vertices lie on the surface, neighbors share vertices,
/// and triangles are oriented consistently, closed surfaces outward. Every function throws std::invalid_argument,
/// naming the argument and its value, for a size that is not positive and finite or a count outside 1 ... 50,000,000.

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Sphere about the origin, by parallels and meridians about z.
TriangleMesh make_sphere(double radius, std::int64_t triangle_count);

/// Torus about z: the tube of radius `minor_radius` around the circle of radius `major_radius`, which must be larger.
TriangleMesh make_torus(double major_radius, double minor_radius, std::int64_t triangle_count);

/// Hyperboloid of one sheet about z, open at both ends: radius `waist_radius` at z = 0, and the larger `rim_radius` at
/// z = ± height/2.
TriangleMesh make_hyperboloid(double waist_radius, double rim_radius, double height, std::int64_t triangle_count);

/// Box about the origin with edge lengths `size`; each face is a grid of about square cells.
TriangleMesh make_box(const Eigen::Vector3d& size, std::int64_t triangle_count);

/// Flat open sheet without thickness in the plane z = 0, about the origin, facing +z.
TriangleMesh make_plate(const Eigen::Vector2d& size, std::int64_t triangle_count);

/// Cylinder shell about z, without thickness, open at both ends z = ± length/2.
TriangleMesh make_tube(double radius, double length, std::int64_t triangle_count);

/// Round shell without thickness, open at both ends, swept along the smooth curve (Catmull-Rom spline) through
/// `points`: at least two, no two successive ones equal. Does not look for self-intersection where the curve is too
/// tight.
TriangleMesh make_hose(std::span<const Eigen::Vector3d> points, double radius, std::int64_t triangle_count);

/// Surface of revolution about z of the polygon through `profile` (points r ≥ 0, z), with `segments` ≥ 3 steps around.
/// Ends on the axis (r = 0) close the surface there; `closed` joins the last point to the first. Going along the
/// profile with the axis on the left, triangles face away from the axis.
TriangleMesh make_revolution(std::span<const Eigen::Vector2d> profile, bool closed, int segments);

}  // namespace glissade::geometry
