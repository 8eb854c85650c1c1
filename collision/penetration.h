#pragma once

/// How to get two overlapping meshes apart by a translation (paper §6): for parts that start inside something, and for
/// telling how deep they are.

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

namespace glissade::collision {

/// A way out.
struct Penetration {
  /// Translation of B in the frame of A after which the meshes are apart; zero if they are to begin with. Metres.
  Eigen::Vector3d way_out_A = Eigen::Vector3d::Zero();

  double depth() const { return way_out_A.norm(); }
};

/// A short translation of B that brings the meshes further apart than `clearance` (metres, ≥ 0), by the exact queries
/// of `dop_query.h` for the pose X_AB.
///
/// The depth is an upper bound of the translational penetration depth, and certain: the way out has been tried. That it
/// is the shortest is an estimate. Tried are directions all around, those of the triangles that intersect, and then
/// those near the best so far, down to some thousandths of its length; for convex bodies that comes within a few per
/// cent. Meshes are surfaces without inside: what lies within a closed one without touching it is apart, and the
/// shortest way out of a shell may lead into it. Nothing is said of the way itself, on which they may meet others, or
/// each other.
///
/// Deterministic. Cost: some hundred queries. Throws as the queries do.
Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                         QueryWorkspace& workspace, double clearance = 0.0);

}  // namespace glissade::collision
