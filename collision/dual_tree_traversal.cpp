#include <bit>
#include <limits>

#include <glissade/collision/dual_tree_traversal.h>
#include <glissade/geometry/triangle_pair.h>

#include "query/dop_traversal.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/workspace_access.h"

namespace glissade::collision {
namespace {

/// Passes the pairs of a traversal on to the visitor.
class NearPairs final : public PlacedVisitor {
 public:
  NearPairs(const PlacedTrees& placed, double distance, DualTreeVisitor& visitor)
      : PlacedVisitor(placed), distance_(distance), visitor_(visitor) {}

  PairMask to_open(const NodePair& nodes, PairMask near) override {
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const TreeChild child_M{nodes.node_M, pair / kWidth};
      const TreeChild child_N{nodes.node_N, pair % kWidth};
      const bool base_is_A = placed_.frame.base_is_A;
      if (visitor_.accepts(base_is_A ? child_M : child_N, base_is_A ? child_N : child_M)) near &= ~(1U << pair);
    }
    return near;
  }
  PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_M, leaf_N, pair);
    const geometry::TriangleDistance closest =
        geometry::triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles));
    if (closest.distance <= distance_) visitor_.visit({triangles, closest.distance, closest.p_a, closest.p_b});
    return {false, closest.distance};
  }
  PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    return visit(leaf_M, leaf_N, pair);
  }

 private:
  double distance_;
  DualTreeVisitor& visitor_;
};

}  // namespace

void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                   QueryWorkspace& workspace, DualTreeVisitor& visitor) {
  const PlacedTrees placed{tree_A, tree_B, X_AB};
  QueryMemory& memory = memory_of(workspace);
  memory.counters = {};
  if (placed.frame.spheres_apart(distance)) return;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment, {}, memory.meter);
  NearPairs pairs(placed, distance, visitor);
  visit_every(step, memory, pairs);
}

}  // namespace glissade::collision
