#include <bit>
#include <limits>

#include <glissade/collision/near_visit.h>
#include <glissade/collision/triangle_distance.h>

#include "dop_traversal.h"
#include "pair_visitors.h"
#include "placed_trees.h"

namespace glissade::collision {
namespace {

/// Hands over what a traversal finds.
class NearPairs final : public PlacedVisitor {
 public:
  NearPairs(const PlacedTrees& placed, double distance, NearVisitor& visitor)
      : PlacedVisitor(placed), distance_(distance), visitor_(visitor) {}

  PairMask to_open(const NodePair& nodes, PairMask near) override {
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const TreeChild child_P{nodes.node_P, pair / kWidth};
      const TreeChild child_Q{nodes.node_Q, pair % kWidth};
      const bool base_is_A = placed_.frame.base_is_A;
      if (visitor_.takes(base_is_A ? child_P : child_Q, base_is_A ? child_Q : child_P)) near &= ~(1U << pair);
    }
    return near;
  }
  PairOutcome visit(std::uint32_t leaf_P, std::uint32_t leaf_Q, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_P, leaf_Q, pair);
    const TriangleDistance closest = triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles));
    if (closest.distance <= distance_) visitor_.visit({triangles, closest.distance, closest.p_a, closest.p_b});
    return {false, closest.distance};
  }
  PairOutcome found(std::uint32_t leaf_P, std::uint32_t leaf_Q, int pair) override {
    return visit(leaf_P, leaf_Q, pair);
  }

 private:
  double distance_;
  NearVisitor& visitor_;
};

}  // namespace

void visit_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                QueryWorkspace& workspace, NearVisitor& visitor) {
  const PlacedTrees placed{tree_A, tree_B, X_AB};
  QueryWorkspace::Memory& memory = workspace.memory();
  memory.counters = {};
  if (placed.frame.spheres_apart(distance)) return;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment);
  NearPairs pairs(placed, distance, visitor);
  traverse(Goal::kEveryPair, step, memory, pairs);
}

}  // namespace glissade::collision
