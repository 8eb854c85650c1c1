#pragma once

/// Where a part among convex obstacles should come to rest, found by other means than the library's: no closest
/// features, no contact list, no projection and no active set.
///
/// Two convex bodies are further apart than m exactly if a plane with unit normal n and offset d has one on its near
/// side and the other more than m beyond it: n·a ≤ d for the corners a of one, n·b ≥ d + m for those of the other. With
/// the planes as unknowns beside the pose, all constraints are smooth, whatever features are near each other, and the
/// energy of the spring is minimised by an interior-point method (log barrier, Newton steps with exact second
/// derivatives). The multipliers are the forces of the corners on the planes.
/// Parts and obstacles that are not convex are given as convex pieces.

#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

#include "solver/projection.h"

namespace glissade::test_support {

/// The hull of some points, metres.
using ConvexPiece = std::vector<Eigen::Vector3d>;

struct RestProblem {
  std::vector<ConvexPiece> part_V;
  std::vector<ConvexPiece> obstacles_W;
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  ///< where the spring acts
  haptics::CouplingStiffness stiffness{};
  double margin = 0.0;  ///< metres
};

struct RestOptimum {
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  double energy = 0.0;  ///< ½ ξ*ᵀ K ξ*, joules
  /// The least distance of a piece of the part from an obstacle, metres, by exact quadratic programming.
  double least_distance = 0.0;
  bool converged = false;
};

/// The local minimum of ½ ξ*ᵀ K ξ* that is reached from X_WV_start downhill, ξ* leading from the part to the ghost at
/// X_WG. At the start every piece must be further from every obstacle than the margin; throws std::invalid_argument
/// otherwise. Poses are good to about a nanometre and a nanoradian where contacts push with more than a millinewton.
///
/// Bodies that turn have local minima, also convex ones: another facet, another tilt. With a short `longest_step`
/// (metres that no point of the part exceeds) the search does not leap over the ridge between two of them.
RestOptimum find_rest(const RestProblem& problem, const Eigen::Isometry3d& X_WG, const Eigen::Isometry3d& X_WV_start,
                      double longest_step = std::numeric_limits<double>::infinity());

/// The corners of a mesh as one piece, whose hull the mesh is supposed to be.
ConvexPiece piece_of(const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X = Eigen::Isometry3d::Identity());

}  // namespace glissade::test_support
