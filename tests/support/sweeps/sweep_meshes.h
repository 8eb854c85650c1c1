#pragma once

/// Small meshes that are difficult for collision queries: soups, needles, ribs, layers, duplicates, triangles without
/// area, and meshes on an integer grid, where touching and coplanar triangles are the rule.

#include <string>

#include <glissade/geometry/triangle_mesh.h>

#include "random_numbers.h"

namespace glissade::test_support {

/// A mesh somewhere in its own frame.
struct SweepMesh {
  geometry::TriangleMesh mesh;
  double size;             ///< about its radius, metres
  Eigen::Vector3d center;  ///< of its bounding box
  std::string description;
};

/// A mesh of a random kind about `center`, with about the radius `size` and 10 to 200 triangles, at least one with
/// area.
SweepMesh random_mesh(double size, const Eigen::Vector3d& center, RandomNumbers& random);

/// The same with all vertices on a grid of spacing `cell` through the origin; exact if `cell` is a power of two and
/// `center` a multiple of it.
SweepMesh random_grid_mesh(double cell, const Eigen::Vector3d& center, RandomNumbers& random);

/// Moves the vertices by up to `size` or a small fraction of it, and some onto others, so that some triangles lose
/// their area, but not all.
void deform(geometry::TriangleMesh& mesh, double size, RandomNumbers& random);

/// A smooth sphere, torus or plate of about `triangles` triangles, of radius about 1 and about the origin.
geometry::TriangleMesh random_surface(int triangles, RandomNumbers& random);

}  // namespace glissade::test_support
