#pragma once

/// Objects for benchmarks and tests of collision detection, with any number of triangles (paper, figure 1). The objects
/// are car parts with many curved and flat components, nested thin shells, and solid parts in the interior.
/// `mesh_generators.h` has the simple surfaces.
///
/// `triangle_count` refines the tessellation and leaves the shape unchanged. The result is deterministic. From 1,000 to
/// 1,000,000 triangles, the number of triangles matches the count within 15 %. Below 1,000 there are more triangles if
/// the shape needs them. Below 8,000 triangles, small details (screws, ribs, teeth, mirrors) are omitted. Sizes are in
/// metres and include the details. From 8,000 triangles on, stated sizes hold within 3 %. Cost is linear in the count.
///
/// The tessellation imitates that of a CAD model. Faces are tessellated one by one and not welded, so the vertices of
/// adjacent faces need not coincide. Triangles differ in size. On flat faces and cylinders they are long and thin, and
/// around holes and on caps they form fans. Sheet metal has no thickness. Components overlap, and some are inside out.
/// No triangle has zero area. Every function throws std::invalid_argument, naming the argument and its value, for a
/// count outside 1 ... 50,000,000.

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// Car headlight, with fluted lens, bezel, three reflectors with bulbs and sockets, double-walled housing with cooling
/// ribs, covers, and fastening tabs. It is about 0.52 m wide along x, 0.24 m deep along y and 0.22 m high along z, and
/// shines along y.
geometry::TriangleMesh make_headlight(std::int64_t triangle_count);

/// Lock of a car door, with punched plates, a rotary latch with pawl, levers, rivets, springs, a worm gear with motor,
/// and a ribbed housing. About 0.13 m × 0.1 m × 0.05 m, with the plates perpendicular to z.
geometry::TriangleMesh make_door_lock(std::int64_t triangle_count);

/// Body of a car in sheet metal without thickness, with open windows and wheel arches, two front seats, a rear bench,
/// dashboard and steering wheel. About 4.1 m along x (forward) and 1.7 m along y (2 m with mirrors), with z from 0.19 m
/// to 1.44 m above the road.
geometry::TriangleMesh make_car_body(std::int64_t triangle_count);

/// Hose of a car engine, with bellows and an inner wall along a path bent in space, and with cuffs, clamps and flanges
/// at the ends. About 0.6 m along x, 0.27 m along y, 0.3 m along z.
geometry::TriangleMesh make_engine_hose(std::int64_t triangle_count);

/// Open sheet without thickness about the origin. Its height is a smooth field of bumps, with `wave_count` waves along
/// each edge and z from -bump_height / 2 to bump_height / 2. Two parallel copies at a small distance along z are the
/// worst case of every bounding-volume hierarchy, because the copies are close everywhere and touch nowhere. The sheet
/// is one welded component of nearly square cells. Also throws std::invalid_argument for a size or height that is not
/// positive and finite, and for a wave count outside 1 ... 10,000.
geometry::TriangleMesh make_bumpy_plate(const Eigen::Vector2d& size, double bump_height, int wave_count,
                                        std::int64_t triangle_count);

/// One object of the suite, with its name and the function that makes its mesh with about `triangle_count` triangles.
struct BenchmarkShape {
  std::string name;
  geometry::TriangleMesh (*make)(std::int64_t triangle_count);
};

/// The suite (paper, figure 1), in the paper's order: headlight, door-lock, car-body, hose, sphere, hyperboloid, torus.
/// The last three are about 1 m in size, and their triangles are welded.
const std::vector<BenchmarkShape>& benchmark_shapes();

}  // namespace glissade::shapes
