#pragma once

/// Seeded pairs of triangles that hit the hard cases of a predicate far more often than uniform sampling.

#include <cstddef>
#include <cstdint>
#include <random>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

struct TrianglePair {
  geometry::TrianglePoints a;
  geometry::TrianglePoints b;
};

/// A stream of pairs of triangles of positive area.
class RandomTriangles {
 public:
  explicit RandomTriangles(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high);
  int integer(int low, int high);
  Eigen::Vector3d point_in_cube(double half_edge);

  /// Corners anywhere in a cube of edge 2.
  TrianglePair anywhere();
  /// Corners on the integer points of a cube of `side` + 1 points an edge: full of shared, coplanar and touching
  /// features.
  TrianglePair on_lattice(int side);
  /// A feature of b (corner, or a point of an edge) lies on a corner, an edge, the inside or the plane of a, and is
  /// then moved by at most a few units in the last place. The scale and the offset from the origin vary.
  TrianglePair nearly_touching();
  /// Both in one generic plane as far as rounding allows.
  TrianglePair nearly_coplanar();

 private:
  Eigen::Vector3d point_of(const geometry::TrianglePoints& triangle);
  Eigen::Vector3d moved_by_ulps(const Eigen::Vector3d& p);

  std::mt19937_64 random_;
};

}  // namespace glissade::test_support
