#pragma once

/// Objects for benchmarks and tests of collision detection, with any number of triangles (paper, figure 1). They are
/// car parts with many curved and flat components, nested thin shells, and solid parts in the interior.
/// `mesh_generators.h` has the simple surfaces.
///
/// `triangle_count` refines the tessellation and leaves the shape unchanged. The result is deterministic. From 1,000 to
/// 1,000,000 triangles the result matches the count within 15 %. Below 1,000 the result has more triangles if the shape
/// needs them. Below 8,000 triangles it omits small details (screws, ribs, teeth, mirrors). Sizes are in metres,
/// include the details, and hold within 3 % from 8,000 triangles on. Cost is linear in the count.
///
/// The tessellation imitates that of a CAD model. Faces are tessellated one by one and not welded, so the vertices of
/// adjacent faces need not coincide. Triangles are of uneven size: long and thin on flat faces and cylinders, fans
/// around holes and on caps. Sheet metal has no thickness. Components overlap, and some are inside out. No triangle has
/// zero area. Every function throws std::invalid_argument, naming the argument and its value, for a count outside 1 ...
/// 50,000,000.

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// Car headlight: fluted lens, bezel, three reflectors with bulbs and sockets, double-walled housing with cooling ribs,
/// covers, and fastening tabs. About 0.52 m wide along x, 0.24 m deep along y, 0.22 m high along z; it shines along y.
geometry::TriangleMesh make_headlight(std::int64_t triangle_count);

/// Lock of a car door: punched plates, a rotary latch with pawl, levers, rivets, springs, a worm gear with motor, and a
/// ribbed housing. About 0.13 m × 0.1 m × 0.05 m, with the plates perpendicular to z.
geometry::TriangleMesh make_door_lock(std::int64_t triangle_count);

/// Body of a car in sheet metal without thickness, with open windows and wheel arches, two front seats, a rear bench,
/// dashboard and steering wheel. About 4.1 m along x (forward) and 1.7 m along y (2 m with mirrors), with z from 0.19 m
/// to 1.44 m above the road.
geometry::TriangleMesh make_car_body(std::int64_t triangle_count);

/// Hose of a car engine: bellows and an inner wall along a path bent in space, with cuffs, clamps and flanges at its
/// ends. About 0.6 m along x, 0.27 m along y, 0.3 m along z.
geometry::TriangleMesh make_engine_hose(std::int64_t triangle_count);

/// Open sheet without thickness about the origin. Its height is a smooth field of bumps, with `wave_count` waves along
/// each edge and z from -bump_height / 2 to bump_height / 2. Two parallel copies at a small distance along z are the
/// worst case of every bounding-volume hierarchy, because they are close everywhere and touch nowhere. The sheet is one
/// welded component of about square cells. Also throws std::invalid_argument for a size or height that is not positive
/// and finite, and for a wave count outside 1 ... 10,000.
geometry::TriangleMesh make_bumpy_plate(const Eigen::Vector2d& size, double bump_height, int wave_count,
                                        std::int64_t triangle_count);

/// One object of the suite: its name, and the function that makes its mesh with about `triangle_count` triangles.
struct BenchmarkShape {
  std::string name;
  geometry::TriangleMesh (*make)(std::int64_t triangle_count);
};

/// The suite (paper, figure 1), in the paper's order: headlight, door-lock, car-body, hose, sphere, hyperboloid, torus.
/// The last three are about 1 m in size, and their triangles are welded.
const std::vector<BenchmarkShape>& benchmark_shapes();

}  // namespace glissade::shapes
