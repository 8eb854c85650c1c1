#pragma once

/// Pairs of triangles of two meshes and their distances, by plain loops, CGAL and quadruple precision, and the
/// comparison of query answers with them.

#include <atomic>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

/// Two triangles and their true distance.
struct NearPair {
  collision::TrianglePair triangles;
  double distance;  ///< 0 exactly if they intersect
  double doubt;     ///< bound of the error in double precision

  std::string text() const;
};

/// The largest errors so far. Thread-safe.
class DistanceErrors {
 public:
  /// `error` of a distance between triangles whose farthest corners are `extent` apart.
  void add(double error, double distance, double extent);
  void print() const;

 private:
  std::atomic<double> worst_relative_ = 0.0;   ///< of distances above a millionth of the extent
  std::atomic<double> worst_of_extent_ = 0.0;  ///< of all, in rounding units of the extent
};

/// Immutable, so any number of threads may use it.
class NearPairs {
 public:
  NearPairs(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B);

  /// Every pair within `limit`, in ascending order, and some slightly beyond it.
  std::vector<NearPair> within(const Eigen::Isometry3d& X_AB, double limit) const;

  /// The error in the distance or the points of `actual`, in words; empty if they are right.
  std::string fault_of(const collision::ClosePair& actual, const NearPair& expected, const Eigen::Isometry3d& X_AB,
                       DistanceErrors& errors) const;

 private:
  geometry::TrianglePoints points_A(std::int32_t triangle) const;
  geometry::TrianglePoints points_B(std::int32_t triangle, const Eigen::Isometry3d& X_AB) const;

  const geometry::TriangleMesh& mesh_A_;
  const geometry::TriangleMesh& mesh_B_;
  std::vector<std::int32_t> triangles_A_;  ///< triangles with area
  std::vector<std::int32_t> triangles_B_;
};

}  // namespace glissade::test_support
