#pragma once

/// Answers of CGAL and of plain loops about two meshes, a reference for the answers of the trees.

#include <functional>
#include <limits>
#include <vector>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

/// Compares the triangles of two meshes one by one, except pairs with separate boxes, found by sorting along an axis.
/// Immutable, so any number of threads may use it.
class MeshOracle {
 public:
  MeshOracle(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B);

  /// Whether any two triangles intersect, by CGAL.
  bool intersects(const Eigen::Isometry3d& X_AB) const;

  /// Every pair of triangles that intersects, by CGAL, in ascending order.
  std::vector<collision::TrianglePair> intersecting_pairs(const Eigen::Isometry3d& X_AB) const;

  /// Every pair within `distance` by `triangle_distance`, in ascending order.
  std::vector<collision::ClosePair> pairs_within(const Eigen::Isometry3d& X_AB, double distance) const;

  /// The corners of both triangles in A.
  geometry::TrianglePoints points_A(std::int32_t triangle) const;
  geometry::TrianglePoints points_B(std::int32_t triangle, const Eigen::Isometry3d& X_AB) const;

  /// The farthest vertex of A, and of B, from its own origin.
  double radius_A() const { return radius_A_; }
  double radius_B() const { return radius_B_; }

 private:
  struct BoxedTriangle {
    geometry::TrianglePoints points;
    Eigen::Array3d low;
    Eigen::Array3d high;
    std::int32_t index;
  };
  using Visit = std::function<bool(const BoxedTriangle&, const BoxedTriangle&)>;

  static BoxedTriangle boxed(const geometry::TrianglePoints& points, std::int32_t index);
  bool traverse_near(const Eigen::Isometry3d& X_AB, double distance, const Visit& visit) const;

  geometry::TriangleMesh mesh_A_;
  geometry::TriangleMesh mesh_B_;
  std::vector<BoxedTriangle> triangles_A_;  ///< in the order of their lower ends along x
  std::vector<std::int32_t> triangles_B_;   ///< those of positive area
  Eigen::Array3d low_A_ = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high_A_ = -low_A_;
  double widest_A_ = 0.0;  ///< largest extent along x
  double radius_A_ = 0.0;
  double radius_B_ = 0.0;
};

}  // namespace glissade::test_support
