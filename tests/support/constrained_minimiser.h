#pragma once

/// The rest pose of a part among convex obstacles, computed independently of the library: without closest features,
/// contact list, projection and active set.
///
/// Two convex bodies are farther apart than m exactly if there is a plane with unit normal n and offset d such that
/// n·a ≤ d for the corners a of one body, and n·b > d + m for the corners b of the other. With the planes as unknowns
/// beside the pose, all constraints are smooth for all pairs of features. An interior-point method (log barrier, Newton
/// steps with exact second derivatives) minimises the energy of the spring. The multipliers are the forces of the
/// corners on the planes.
/// Parts and obstacles that are not convex are given as convex pieces.

#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::test_support {

/// The hull of some points, metres.
using ConvexPiece = std::vector<Eigen::Vector3d>;

struct RestProblem {
  std::vector<ConvexPiece> part_V;
  std::vector<ConvexPiece> obstacles_W;
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  ///< where the spring acts
  contact::CouplingStiffness stiffness{};
  double margin = 0.0;  ///< metres
};

struct RestOptimum {
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  double energy = 0.0;  ///< ½ ξ*ᵀ K ξ*, joules
  /// The smallest distance between a piece of the part and an obstacle, metres, by exact quadratic programming.
  double least_distance = 0.0;
  bool converged = false;
};

/// The local minimum of ½ ξ*ᵀ K ξ* downhill from X_WV_start, with the displacement ξ* from the part to the ghost at
/// X_WG. Throws std::invalid_argument unless every piece is farther from every obstacle than the margin at the start.
/// Poses are accurate to about a nanometre and a nanoradian if contacts push with more than a millinewton.
///
/// Bodies that turn have several local minima, even convex ones: another facet, another tilt. With a short
/// `longest_step` (an upper bound, in metres, of the motion of all points of the part) the search does not jump over
/// the ridge between two of them.
RestOptimum find_rest(const RestProblem& problem, const Eigen::Isometry3d& X_WG, const Eigen::Isometry3d& X_WV_start,
                      double longest_step = std::numeric_limits<double>::infinity());

/// The corners of a convex mesh as one piece.
ConvexPiece piece_of(const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X = Eigen::Isometry3d::Identity());

}  // namespace glissade::test_support
