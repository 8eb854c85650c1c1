#pragma once

/// Pairs of meshes and poses that are difficult for collision queries: anywhere, within rounding errors of contact,
/// flush and touching, exactly degenerate on integer grids; at all scales, of very different sizes, and far from their
/// origins.

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "random_numbers.h"
#include "sweeps/sweep_meshes.h"

namespace glissade::test_support {

/// Positions and sizes of the meshes.
enum class Placement {
  kNear,     ///< about 1 m large, at their origins
  kScaled,   ///< 1 µm to 1 km, both about the same
  kUnequal,  ///< one up to a million times as large as the other
  kFar,      ///< up to a million times their size away from the origin of one frame or both
  kGrid,     ///< all vertices on an integer grid
};

/// The construction of a pose.
enum class Approach {
  kAnywhere,  ///< random, about half of them colliding; on the integer grid: onto the grid
  kBisected,  ///< near a contact found by bisection along a line
  kTouching,  ///< points of features coincide, often flush; or side by side
};

struct SweepFamily {
  Placement placement;
  Approach approach;
};

/// All of them.
std::span<const SweepFamily> sweep_families();
std::string family_name(const SweepFamily& family);

struct SweepPair {
  SweepMesh A;
  SweepMesh B;
  double cell = 0.0;  ///< spacing of the grid of all vertices; 0 without a grid

  /// The smaller size.
  double scale() const { return std::min(A.size, B.size); }
};

SweepPair random_pair(Placement placement, RandomNumbers& random);

/// Whether B at X_AB collides, for bisection.
using Collides = std::function<bool(const Eigen::Isometry3d& X_AB)>;

std::vector<Eigen::Isometry3d> random_poses(const SweepFamily& family, const SweepPair& pair, int count,
                                            const Collides& collides, RandomNumbers& random);

/// All digits, as the rows of the matrix [R | p].
std::string text(const Eigen::Isometry3d& X);
std::string text(double number);

}  // namespace glissade::test_support
