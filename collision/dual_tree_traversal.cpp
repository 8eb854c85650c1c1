#include <bit>
#include <vector>

#include <glissade/collision/dual_tree_traversal.h>

#include "query/dop_traversal.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/workspace_access.h"

namespace glissade::collision {
namespace {

/// Asks the visitor which pairs of children to open, and collects the pairs of triangles.
class NearPairs final : public PlacedVisitor {
 public:
  NearPairs(const PlacedTrees& placed, double distance, DualTreeVisitor& visitor, std::vector<ClosePair>& pairs)
      : PlacedVisitor(placed), visitor_(visitor), collector_(placed, distance, pairs) {}

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
    return collector_.visit(leaf_M, leaf_N, pair);
  }
  bool visit_each(std::uint32_t leaf_M, std::uint32_t leaf_N, PairMask pairs) override {
    return collector_.visit_each(leaf_M, leaf_N, pairs);
  }
  PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    return collector_.found(leaf_M, leaf_N, pair);
  }
  void finish() { collector_.finish(); }

 private:
  DualTreeVisitor& visitor_;
  PairCollector<ClosePair> collector_;
};

}  // namespace

void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                   QueryWorkspace& workspace, DualTreeVisitor& visitor) {
  const PlacedTrees placed{tree_A, tree_B, X_AB};
  QueryMemory& memory = memory_of(workspace);
  memory.counters = {};
  if (placed.frame.spheres_apart(distance)) return;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment, {}, memory.meter);
  memory.close_pairs.clear();
  NearPairs pairs(placed, distance, visitor, memory.close_pairs);
  visit_every(step, memory, pairs);
  pairs.finish();
  for (const ClosePair& pair : memory.close_pairs)
    visitor.visit(pair);
}

}  // namespace glissade::collision
