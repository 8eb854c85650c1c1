#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <glissade/collision/dual_tree_traversal.h>

#include "query/dop_traversal.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/workspace_access.h"

namespace glissade::collision {
namespace {

/// Asks the visitor which pairs of children to open, and collects the pairs of triangles, and the accepted pairs of
/// children.
class NearPairs final : public PlacedVisitor {
 public:
  NearPairs(const PlacedTrees& placed, double distance, DualTreeVisitor& visitor, QueryMemory& memory)
      : PlacedVisitor(placed),
        visitor_(visitor),
        collector_(placed, distance, memory.close_pairs),
        accepted_(memory.accepted) {}

  PairMask to_open(const NodePair& nodes, PairMask near) override {
    PairMask accepted = 0;
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const TreeChild child_M{nodes.node_M, pair / kWidth};
      const TreeChild child_N{nodes.node_N, pair % kWidth};
      const bool base_is_A = placed_.frame.base_is_A;
      if (visitor_.accepts(base_is_A ? child_M : child_N, base_is_A ? child_N : child_M)) accepted |= 1U << pair;
    }
    if (accepted != 0) accepted_.push_back({nodes, accepted, {}});
    return near & ~accepted;
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
  std::vector<OpenPair>& accepted_;
};

/// Appends the selected pairs of triangles below accepted pairs of children.
void collect_below_accepted(const PlacedTrees& placed, double distance, const VisitSelection& selection,
                            QueryMemory& memory) {
  memory.stack.clear();
  for (OpenPair& open : memory.accepted) {
    open.near &= selection.pairs_of_nodes(open.nodes.node_M, open.nodes.node_N);
    if (open.near != 0) memory.stack.push_back(open);
  }
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment, selection, memory.meter);
  PairCollector<ClosePair> collector(placed, distance, memory.close_pairs);
  continue_all(step, memory, collector, std::numeric_limits<std::int64_t>::max());
  collector.finish();
}

}  // namespace

void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                   QueryWorkspace& workspace, DualTreeVisitor& visitor, const PairSelection* below_accepted) {
  const PlacedTrees placed{tree_A, tree_B, X_AB, below_accepted == nullptr ? PairSelection{} : *below_accepted};
  const VisitSelection selection = placed.visit_selection();
  QueryMemory& memory = memory_of(workspace);
  memory.counters = {};
  if (placed.frame.spheres_apart(distance)) return;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment, {}, memory.meter);
  memory.close_pairs.clear();
  memory.accepted.clear();
  const bool shows_selected = placed.selection.of_A != nullptr && placed.selection.of_B != nullptr;
  NearPairs pairs(placed, distance, visitor, memory);
  visit_every(step, memory, pairs);
  pairs.finish();
  const std::size_t others = memory.close_pairs.size();
  if (shows_selected) collect_below_accepted(placed, distance, selection, memory);
  for (std::size_t i = 0; i < others; ++i)
    visitor.visit(memory.close_pairs[i]);
  for (std::size_t i = others; i < memory.close_pairs.size(); ++i)
    visitor.visit_below_accepted(memory.close_pairs[i]);
}

}  // namespace glissade::collision
