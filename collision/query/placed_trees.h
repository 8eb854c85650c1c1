#pragma once

/// The two trees of a query at their relative pose. All corners are in the frame of A.

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>
#include <glissade/geometry/triangle_pair.h>

#include "kernels/query_frame.h"
#include "query/visit_selection.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// Two trees at a relative pose, with access to their triangle pairs.
struct PlacedTrees {
  const DopTree& tree_A;
  const DopTree& tree_B;
  const Eigen::Isometry3d& X_AB;
  PairSelection selection{};
  QueryFrame frame{tree_A, tree_B, X_AB};

  const DopTree& base() const { return frame.base_is_A ? tree_A : tree_B; }
  const DopTree& other() const { return frame.base_is_A ? tree_B : tree_A; }

  /// Throws std::invalid_argument for selections that were made for other trees.
  VisitSelection visit_selection() const {
    return frame.base_is_A ? VisitSelection(base(), other(), selection.of_A, selection.of_B)
                           : VisitSelection(base(), other(), selection.of_B, selection.of_A);
  }

  TrianglePair triangles(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) const {
    const std::int32_t triangle_M = leaves_of(base())[leaf_M].triangle[static_cast<std::size_t>(pair / kWidth)];
    const std::int32_t triangle_N = leaves_of(other())[leaf_N].triangle[static_cast<std::size_t>(pair % kWidth)];
    return frame.base_is_A ? TrianglePair{triangle_M, triangle_N} : TrianglePair{triangle_N, triangle_M};
  }
  geometry::TrianglePoints points_A(const TrianglePair& pair) const {
    const geometry::TriangleMesh& mesh = tree_A.mesh();
    return mesh.corners(pair.triangle_A);
  }
  geometry::TrianglePoints points_B(const TrianglePair& pair) const {
    const geometry::TriangleMesh& mesh = tree_B.mesh();
    return {X_AB * mesh.corner(pair.triangle_B, 0), X_AB * mesh.corner(pair.triangle_B, 1),
            X_AB * mesh.corner(pair.triangle_B, 2)};
  }
};

}  // namespace glissade::collision
