#pragma once

/// How the two trees of a query lie to each other, and how much rounding may have moved what.
///
/// The tree of larger radius is the base M; nodes of the other tree, N, are realigned into its frame. Both are seen
/// from their centres; lengths are in radii of M.

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

struct QueryFrame {
  /// X_AB as the queries take it. Throws std::invalid_argument when it is not finite or its matrix not a rotation
  /// (`rotation_defect` below 1e-3), and for trees of different options.
  QueryFrame(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB);

  /// Which of two trees is the base.
  static bool base_is_first(const DopTree& tree_A, const DopTree& tree_B) { return tree_A.radius() >= tree_B.radius(); }

  bool base_is_A;
  Eigen::Matrix3d R_MN;
  Eigen::Vector3d p_MN;  ///< centre of N seen from the centre of M, in radii of M
  double ratio;          ///< radius of N over radius of M, ≤ 1
  double base_radius;    ///< of M, in metres

  /// How far double precision may have moved a point of N, in radii of M: rounding of poses and differences, and what
  /// keeps the matrix from being a rotation.
  double uncertainty;
  /// The absolute values of the entries of RᵀR − 1, added up: 0 of a true rotation, and a bound of any norm.
  double rotation_defect;

  /// A lower bound of the gap between the two bounding spheres, in radii of M; negative when they overlap.
  double gap_of_spheres() const { return (p_MN.norm() - 1.0 - ratio) * (1.0 - 1e-12) - uncertainty; }

  /// The two bounding spheres are certainly further apart than `tolerance` (metres). Throws std::invalid_argument when
  /// that is negative or not a number.
  bool spheres_apart(double tolerance) const;

  /// An upper bound, in radii of M, of distances in M's frame that are `distance` metres in the frame of A.
  double in_base_radii(double distance) const {
    return distance / base_radius * (1.0 + 2.0 * rotation_defect) * (1.0 + 1e-12);
  }
};

}  // namespace glissade::collision
