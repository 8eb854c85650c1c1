// The least distance of two trees, by branch and bound: pairs of nodes in ascending order of their lower bounds, as
// long as these are below the least distance found.

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include <glissade/geometry/triangle_pair.h>

#include "query/coherent_front.h"
#include "query/dop_traversal.h"
#include "query/placed_trees.h"
#include "query/workspace_access.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

class GapSearch {
 public:
  GapSearch(const PlacedTrees& placed, double limit, QueryMemory& memory)
      : placed_(placed),
        memory_(memory),
        step_(placed.base(), placed.other(), placed.frame, std::numeric_limits<double>::infinity(), memory.alignment),
        least_(limit) {}

  /// Begins with this triangle pair. The choice affects the amount of work only.
  void begin_with(const NearestPair& pair) { compare(pair.leaf_M, pair.leaf_N, pair.pair); }

  /// The nearest pair, if its distance is below the limit.
  const std::optional<NearestPair>& nearest() const { return nearest_; }

  double run() {
    memory_.promising.assign(1, {{0, 0, kAllPairs}, 0.0});
    while (!memory_.promising.empty()) {
      const PromisingPair top = memory_.promising.back();
      memory_.promising.pop_back();
      if (top.gap < least_) expand(top.nodes);
    }
    return least_;
  }

 private:
  double in_metres(double radii) const { return radii * placed_.frame.base_radius; }

  void expand(const NodePair& nodes) {
    PairOverlaps overlaps;
    const PairMask all = step_.nodes(nodes, overlaps, memory_.counters);
    step_.thin_slabs(nodes, all, overlaps);
    const std::size_t first = memory_.promising.size();
    for (PairMask rest = all; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const double gap =
          in_metres(-overlaps.overlap[static_cast<std::size_t>(pair)] / static_cast<double>(kGridRadius));
      if (gap >= least_) continue;
      // One pair at a time, because each has a gap of its own.
      const Descent descent = step_.descend(nodes, 1U << pair, pair);
      if (descent.is_leaf) {
        compare_leaves(descent.next.node_M, descent.next.node_N);
      } else {
        memory_.promising.push_back({descent.next, gap});
      }
    }
    std::sort(memory_.promising.begin() + static_cast<std::ptrdiff_t>(first), memory_.promising.end(),
              [](const PromisingPair& u, const PromisingPair& v) { return u.gap > v.gap; });
  }

  void compare_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N) {
    step_.prepare(leaf_M, leaf_N, leaves_);
    if (in_metres(step_.leaf_gap(leaves_, memory_.counters)) >= least_) return;
    for (PairMask rest = step_.edges(leaves_, step_.leaves(leaves_, memory_.counters)); rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      if (in_metres(static_cast<double>(leaves_.gaps.gap[static_cast<std::size_t>(pair)])) >= least_) continue;
      compare(leaf_M, leaf_N, pair);
    }
  }

  void compare(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) {
    const TrianglePair triangles = placed_.triangles(leaf_M, leaf_N, pair);
    const double distance =
        geometry::triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles)).distance;
    if (!(distance < least_)) return;
    least_ = distance;
    nearest_ = NearestPair{placed_.base().id(), placed_.other().id(), leaf_M, leaf_N, pair};
  }

  const PlacedTrees& placed_;
  QueryMemory& memory_;
  DopVisit step_;
  double least_;  ///< metres
  VisitedLeaves leaves_;
  std::optional<NearestPair> nearest_;
};

// The search finds the least of all computed distances, wherever it begins: bounds by boxes and normals are below true
// distances by far more than the rounding of distances.
double bound(const PlacedTrees& placed, double limit, QueryMemory& memory, std::optional<NearestPair>& nearest) {
  memory.counters = {};
  const double rounding = 4.0 * placed.frame.uncertainty * placed.frame.base_radius;
  if (placed.frame.spheres_apart(limit)) return limit;
  // At this distance boxes cannot be distinguished: their gaps may leave the range of 16 bits.
  const double between_spheres = placed.frame.base_radius * placed.frame.gap_of_spheres();
  if (between_spheres > placed.frame.base_radius) return std::min(between_spheres, limit);
  GapSearch search(placed, limit, memory);
  if (nearest && nearest->base_id == placed.base().id() && nearest->other_id == placed.other().id()) {
    search.begin_with(*nearest);
  }
  const double least = search.run();
  nearest = search.nearest();
  return least == limit ? limit : std::min(limit, std::max(0.0, least * (1.0 - 1e-12) - rounding));
}

}  // namespace

double gap_lower_bound(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                       QueryWorkspace& workspace, double limit) {
  std::optional<NearestPair> nearest;
  return bound({tree_A, tree_B, X_AB}, limit, memory_of(workspace), nearest);
}

double gap_lower_bound(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                       CoherentWorkspace& workspace, double limit) {
  return bound({tree_A, tree_B, X_AB}, limit, memory_of(WorkspaceAccess::scratch(workspace)),
               WorkspaceAccess::front(workspace).nearest());
}

}  // namespace glissade::collision
