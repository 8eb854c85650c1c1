#include <algorithm>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/triangle_distance.h>
#include <glissade/collision/triangle_intersection.h>

#include "dop_alignment.h"

namespace glissade::collision {

/// The simultaneous traversal of both trees, shared by all queries: visits every pair of leaf triangles whose nodes no
/// slab proves to be further apart than a distance.
class DopTraversal {
 public:
  DopTraversal(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
               QueryWorkspace& workspace)
      : tree_A_(tree_A),
        tree_B_(tree_B),
        X_AB_(X_AB),
        alignment_(X_AB, tree_A.largest_coordinate(), tree_B.largest_coordinate()),
        separation_(separation_thresholds(distance)),
        workspace_(workspace) {
    workspace_.counters_ = {};
  }

  /// Calls visit(triangle_A, points_A, triangle_B, points_B), all points in A, until it returns true. Returns whether
  /// it did.
  template <typename Visit>
  bool run(const Visit& visit) {
    workspace_.stack_.clear();
    if (!disjoint(tree_A_.nodes().front().dop, realigned(0), separation_)) workspace_.stack_.push_back({0, 0});
    ++workspace_.counters_.node_tests;
    while (!workspace_.stack_.empty()) {
      const QueryWorkspace::NodePair pair = workspace_.stack_.back();
      workspace_.stack_.pop_back();
      const DopNode& node_A = tree_A_.nodes()[static_cast<std::size_t>(pair.node_A)];
      const DopNode& node_B = tree_B_.nodes()[static_cast<std::size_t>(pair.node_B)];
      if (node_A.is_leaf() && node_B.is_leaf()) {
        if (visit_leaves(node_A, node_B, visit)) return true;
      } else {
        descend(pair, node_A, node_B);
      }
    }
    return false;
  }

 private:
  /// Computing a realigned node again is cheaper than fetching a stored one.
  Dop realigned(std::int32_t node_B) {
    ++workspace_.counters_.realignments;
    return alignment_.realign(tree_B_.nodes()[static_cast<std::size_t>(node_B)].dop);
  }

  /// Opens both nodes at once (a leaf stands for itself) and keeps the pairs that overlap.
  void descend(const QueryWorkspace::NodePair& pair, const DopNode& node_A, const DopNode& node_B) {
    const std::int32_t first_A = node_A.is_leaf() ? pair.node_A : node_A.first;
    const std::int32_t first_B = node_B.is_leaf() ? pair.node_B : node_B.first;
    const std::int32_t end_A = first_A + (node_A.is_leaf() ? 1 : 2);
    const std::int32_t end_B = first_B + (node_B.is_leaf() ? 1 : 2);
    for (std::int32_t b = first_B; b < end_B; ++b) {
      const Dop dop_B = realigned(b);
      for (std::int32_t a = first_A; a < end_A; ++a) {
        ++workspace_.counters_.node_tests;
        if (!disjoint(tree_A_.nodes()[static_cast<std::size_t>(a)].dop, dop_B, separation_)) {
          workspace_.stack_.push_back({a, b});
        }
      }
    }
  }

  template <typename Visit>
  bool visit_leaves(const DopNode& leaf_A, const DopNode& leaf_B, const Visit& visit) {
    for (std::int32_t j = leaf_B.first; j < leaf_B.first + leaf_B.count; ++j) {
      const std::int32_t triangle_B = tree_B_.leaf_triangles()[static_cast<std::size_t>(j)];
      const TriangleMesh& mesh_B = tree_B_.mesh();
      const TrianglePoints points_B{X_AB_ * mesh_B.corner(triangle_B, 0), X_AB_ * mesh_B.corner(triangle_B, 1),
                                    X_AB_ * mesh_B.corner(triangle_B, 2)};
      for (std::int32_t i = leaf_A.first; i < leaf_A.first + leaf_A.count; ++i) {
        const std::int32_t triangle_A = tree_A_.leaf_triangles()[static_cast<std::size_t>(i)];
        const TriangleMesh& mesh_A = tree_A_.mesh();
        const TrianglePoints points_A{mesh_A.corner(triangle_A, 0), mesh_A.corner(triangle_A, 1),
                                      mesh_A.corner(triangle_A, 2)};
        ++workspace_.counters_.triangle_tests;
        if (visit(triangle_A, points_A, triangle_B, points_B)) return true;
      }
    }
    return false;
  }

  const DopTree& tree_A_;
  const DopTree& tree_B_;
  const Eigen::Isometry3d& X_AB_;
  DopAlignment alignment_;
  std::array<float, kDopDirections> separation_;
  QueryWorkspace& workspace_;
};

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance) {
  return DopTraversal(tree_A, tree_B, X_AB, tolerance, workspace)
      .run([&](std::int32_t, const TrianglePoints& a, std::int32_t, const TrianglePoints& b) {
        return tolerance > 0.0 ? triangle_distance(a, b).distance <= tolerance : triangles_intersect(a, b);
      });
}

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance) {
  return intersects(tree_A, tree_B, X_AB, workspace.workspace(), tolerance);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  pairs.clear();
  DopTraversal(tree_A, tree_B, X_AB, tolerance, workspace)
      .run([&](std::int32_t triangle_A, const TrianglePoints& a, std::int32_t triangle_B, const TrianglePoints& b) {
        if (tolerance > 0.0 ? triangle_distance(a, b).distance <= tolerance : triangles_intersect(a, b)) {
          pairs.push_back({triangle_A, triangle_B});
        }
        return false;
      });
  std::sort(pairs.begin(), pairs.end());
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  intersecting_pairs(tree_A, tree_B, X_AB, workspace.workspace(), pairs, tolerance);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs) {
  pairs.clear();
  DopTraversal(tree_A, tree_B, X_AB, distance, workspace)
      .run([&](std::int32_t triangle_A, const TrianglePoints& a, std::int32_t triangle_B, const TrianglePoints& b) {
        const TriangleDistance closest = triangle_distance(a, b);
        if (closest.distance <= distance) {
          pairs.push_back({{triangle_A, triangle_B}, closest.distance, closest.p_a, closest.p_b});
        }
        return false;
      });
  std::sort(pairs.begin(), pairs.end(),
            [](const ClosePair& u, const ClosePair& v) { return u.triangles < v.triangles; });
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs) {
  pairs_within(tree_A, tree_B, X_AB, distance, workspace.workspace(), pairs);
}

}  // namespace glissade::collision
