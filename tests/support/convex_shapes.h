#pragma once

/// Random convex meshes, for tests of resting parts.

#include <span>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "random_numbers.h"

namespace glissade::test_support {

/// The hull of a few points in general position, by trying all triples: cost O(n⁴).
geometry::TriangleMesh hull_mesh(std::span<const Eigen::Vector3d> points);

/// A box, a sphere or a random hull about the origin, with about the radius `radius` (metres).
geometry::TriangleMesh random_convex_mesh(RandomNumbers& random, double radius);

}  // namespace glissade::test_support
