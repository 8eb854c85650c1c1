#pragma once

/// Whether two convex hulls are apart, in nanoseconds for a pair that moves little from one query to the next (paper
/// §2.2): the plane that separated them last time mostly still does, and so do four pairs of corners that proved the
/// opposite.

#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/collision/convex_hull.h>

namespace glissade::collision {

/// How hulls are told apart once the plane of the last query does not separate them any more.
enum class HullTest : std::uint8_t {
  kExact,       ///< GJK from where it was last time, to the end
  kPerceptron,  ///< the paper's: up to 300 learning steps; it may miss that hulls are apart, never that they meet
};

/// What a pair of hulls remembers of its last query. All of it is a guess: whatever is remembered, the answer is the
/// same, but where rounding leaves it open. Keep one for each pair of objects, in their order. Not thread-safe.
struct HullMemory {
  /// The plane, once fixed to A and once to B: a unit normal from A to B, and how far the hull reaches along it.
  Eigen::Vector3d n_A = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_B = Eigen::Vector3d::Zero();
  double reach_A = 0.0;  ///< of A along n_A
  double reach_B = 0.0;  ///< of B against n_B

  /// A lower bound of the distance in metres along a unit vector, from A to B in the frame of A, if the last answer was
  /// that they are apart; else 0.
  double gap = 0.0;
  Eigen::Vector3d n_gap_A = Eigen::Vector3d::Zero();

  std::int32_t corner_A = 0;  ///< where climbing begins
  std::int32_t corner_B = 0;
  std::array<std::array<std::int32_t, 2>, 4> simplex{};  ///< corners of A and B, the last that GJK had in hand
  std::int8_t simplex_count = 0;
  std::int8_t planes_to_leave = 0;  ///< that many new planes are taken as they are found, without a try to turn them
  bool has_plane = false;
  bool met = false;  ///< the last answer was that they may meet

  std::int32_t loops = 0;  ///< of the last query: learning steps and rounds of GJK
};

/// Whether two hulls are certainly apart, at the pose X_AB of B in the frame of A. By default exact for the points that
/// the hulls were made of, but for gaps that are lost in rounding (1e-13 of all coordinates that take part, 1e-11 for
/// needles, and `ConvexHull::outside`), where the answer is no. Touching hulls are not apart.
///
/// Allocates nothing. Cost: about twenty nanoseconds while the plane or the four pairs hold, less than a microsecond
/// otherwise after a small movement, some microseconds after a large one; bounded in any case. Different threads may
/// ask about the same hulls, with memories of their own.
bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Eigen::Isometry3d& X_AB, HullMemory& memory,
                 HullTest test = HullTest::kExact) noexcept;

}  // namespace glissade::collision
