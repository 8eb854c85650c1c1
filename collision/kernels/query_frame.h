#pragma once

/// The relative pose of the two trees of a query, with bounds of its errors.
///
/// The tree of larger radius is the base M; nodes of the other tree, N, are realigned into its frame. Coordinates are
/// relative to the centres of the trees; lengths are in radii of M.

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

struct QueryFrame {
  /// Takes X_AB as the queries do. Throws std::invalid_argument if its matrix is not a rotation (`rotation_defect`
  /// below 1e-3), if the absolute
  /// coordinates of its translation add up to more than 1e12 m, for meshes more than 1e18 of their radii apart, and for
  /// trees with different options.
  QueryFrame(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB);

  /// Whether the first of two trees is the base.
  static bool base_is_first(const DopTree& tree_A, const DopTree& tree_B) { return tree_A.radius() >= tree_B.radius(); }

  bool base_is_A;
  Eigen::Matrix3d R_MN;
  Eigen::Vector3d p_MN;  ///< centre of N seen from the centre of M, in radii of M
  double ratio;          ///< radius of N over radius of M, ≤ 1
  double base_radius;    ///< of M, in metres

  /// Bound on the error of a point of N in double precision, in radii of M: rounding of poses and differences, and the
  /// deviation of the matrix from a rotation.
  double uncertainty;
  /// The sum of the absolute entries of RᵀR − 1: 0 for an exact rotation, and an upper bound of any norm of that
  /// matrix.
  double rotation_defect;

  /// A lower bound of the gap between the two bounding spheres, in radii of M; negative when they overlap.
  double gap_of_spheres() const { return (p_MN.norm() - 1.0 - ratio) * (1.0 - 1e-12) - uncertainty; }

  /// Whether the two bounding spheres are certainly farther apart than `tolerance` (metres). Throws
  /// std::invalid_argument if `tolerance` is negative or not a number.
  bool spheres_apart(double tolerance) const;

  /// A lower bound, in metres in the frame of A, of a gap in radii of M.
  double in_metres(double gap) const { return gap * base_radius / (1.0 + 2.0 * rotation_defect) * (1.0 - 1e-12); }

  /// An upper bound, in radii of M, of a distance in the frame of M that is `distance` metres in the frame of A.
  double in_base_radii(double distance) const {
    return distance / base_radius * (1.0 + 2.0 * rotation_defect) * (1.0 + 1e-12);
  }
};

}  // namespace glissade::collision
