#pragma once

/// Lower bounds of the distances of four children of one tree to four of the other, for queries of the least distance.
///
/// A DOP bounds a mesh along any direction, not only along its own: the offsets of three half-spaces, weighted, bound
/// every direction in the cone of theirs (`dop_alignment.h`). So both nodes are enclosed in boxes along the same three
/// orthogonal directions. The distance of two such boxes is a bound that does not get looser with the distance, because
/// it combines the gaps along all three directions. There are three such frames: the axes of M, the axes of N, and one
/// whose first direction joins the nearest points found so far. Along this direction, all of two convex meshes are as
/// far apart as these points, or farther.

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "kernels/child_pairs.h"
#include "kernels/query_frame.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// How the reach of a node of one tree along a direction follows from its slabs: three quarter lines (`quarter_line.h`,
/// plain numbers) with their weights, in grid steps of M. The reach to the opposite side takes the opposite offsets.
struct ReachAlong {
  std::array<std::uint8_t, 3> quarter;
  std::array<float, 3> weight;
  float padding;  ///< covers rounding; that of M also the uncertainty of the query
};

/// Three orthogonal unit directions, and how both trees reach along them.
struct BoxFrame {
  std::array<ReachAlong, 3> of_M;
  std::array<ReachAlong, 3> of_N;
  std::array<float, 3> first_M;  ///< the first direction in the axes of M, and in those of N
  std::array<float, 3> first_N;
  float scale_N;                 ///< one grid step of N in grid steps of M
  std::array<float, 3> between;  ///< from the centre of M to that of N along each direction, in grid steps of M
};

/// The columns of `axes` are orthonormal, in the frame of M. `nearer` (radii of M) is subtracted along the first:
/// bounds along it are then of a distance less this, and keep their digits however far apart the trees are. k as for
/// `dop_directions`.
BoxFrame box_frame(int k, const QueryFrame& frame, const Eigen::Matrix3d& axes, double nearer = 0.0);

/// For each pair of children a lower bound of its distance in radii of M. Negative if no direction separates them: then
/// its absolute value says how deep they overlap.
struct alignas(64) DistanceBounds {
  std::array<float, kWidth * kWidth> bound;
};

inline constexpr std::size_t kBoxFrames = 3;

/// Both parts of a node.
struct BoundedNode {
  const NodeHead& head;
  const SlabLine* slabs;
};

/// Set the bounds of all 16 pairs; those of children that do not exist have no meaning. `bound_along` has only the
/// first direction of one frame, from M to N.
void bound_distances(const std::array<BoxFrame, kBoxFrames>& frames, const BoundedNode& node_M,
                     const BoundedNode& node_N, int slabs, DistanceBounds& bounds);
void bound_along(const BoxFrame& frame, const BoundedNode& node_M, const BoundedNode& node_N, int slabs,
                 DistanceBounds& bounds);

}  // namespace glissade::collision
