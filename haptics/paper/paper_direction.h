#pragma once

/// The new direction after a contact (paper §3.2): what the contact points leave of the motion that was wanted.

#include <optional>
#include <span>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

#include "solver/projection.h"

namespace glissade::haptics {

/// A translation that contacts allow, and by how many of them it is bent.
struct NewTranslation {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< metres
  int planes = 0;                               ///< 0 to 2; 3 where nothing is left
};

/// For a translation, by the number of contact points:
/// - 1: what is wanted, projected on the tangent plane;
/// - 2: along the line in which the two tangent planes meet;
/// - 3 and more: nothing, if three of the normals are independent; else their number is reduced.
/// Ours is which of the points count: those whose planes the motion would otherwise cross. So a contact never holds a
/// part that moves away from it, several points on one plane are one, and of all motions so allowed it is the longest.
/// More than 32 different normals are too many to try all pairs: the 32 most opposed to the motion count.
/// Normals are unit vectors from the obstacles to the part. Thread-safe.
NewTranslation new_translation(const Eigen::Vector3d& wanted, std::span<const Eigen::Vector3d> normals);

/// For translation and rotation, which the paper leaves to a thesis that is not at hand; so all of it is ours: the
/// displacement nearest to `wanted`, in the metric of the coupling, that moves no contact point r into its tangent
/// plane, n·(v + w × r) ≥ the row's bound. One, two, three contact points then leave five, four, three degrees of
/// freedom. Also where no rotation is wanted (the rubber band) the contacts turn the part. None where the rows cannot
/// all be met; that is never so with bounds of 0.
std::optional<geometry::Displacement> new_motion(const geometry::Displacement& wanted,
                                                 const CouplingStiffness& stiffness,
                                                 std::span<const ConstraintRow> rows, ProjectionSolver& solver);

}  // namespace glissade::haptics
