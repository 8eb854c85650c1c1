#pragma once

/// The new direction after a contact (paper §3.2): the part of the wanted motion that the contact points allow.

#include <optional>
#include <span>

#include <Eigen/Core>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

namespace glissade::reference {

/// A translation that contacts allow, and the number of tangent planes that deflect it.
struct NewTranslation {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< metres
  int planes = 0;                               ///< 0 to 2; 3 where nothing is left
};

/// The allowed translation, by the number of contact points:
/// - 1: `wanted` projected on the tangent plane;
/// - 2: `wanted` projected on the line in which the two tangent planes meet;
/// - 3 and more: none if three of the normals are independent; otherwise their number is reduced.
///
/// Our addition is the choice of the points that count: only those whose planes the motion would otherwise cross. So a
/// contact never holds a part that moves away from it, several points on one plane count as one, and the longest of the
/// allowed motions is taken. All pairs of normals are tried; of more than 32 different normals, only the 32 most
/// opposed to the motion count. Normals are unit vectors from the obstacles to the part. Thread-safe.
NewTranslation new_translation(const Eigen::Vector3d& wanted, std::span<const Eigen::Vector3d> normals);

/// The allowed displacement with rotation. The paper leaves it to a thesis that is not at hand, so the method is ours:
/// the displacement nearest to `wanted`, in the metric of the coupling, that moves no contact point r into its tangent
/// plane, n·(v + w × r) ≥ the row's bound. One, two or three contact points then leave five, four or three degrees of
/// freedom. The contacts turn the part even where no rotation is wanted (the rubber band). Returns nothing if the rows
/// cannot all be met, which never happens with bounds of 0.
std::optional<geometry::Displacement> new_motion(const geometry::Displacement& wanted,
                                                 const contact::CouplingStiffness& stiffness,
                                                 std::span<const contact::ConstraintRow> rows,
                                                 contact::ProjectionSolver& solver);

}  // namespace glissade::reference
