#pragma once

/// One step of a dual-tree traversal: the test of two nodes, or of two leaves.

#include <array>
#include <cstdint>
#include <optional>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>

#include "kernels/distance_bounds.h"
#include "kernels/dop_alignment.h"
#include "kernels/leaf_kernels.h"
#include "kernels/node_kernels.h"
#include "kernels/query_frame.h"
#include "kernels/thin_slab.h"
#include "kernels/vertex_alignment.h"
#include "query/visit_selection.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// Two nodes to test, and the pairs of their children to consider. A child that is a leaf, or much smaller than the
/// node of the other tree, may stay a child of its node while the other is opened: only the pairs with this child are
/// considered then.
struct NodePair {
  std::uint32_t node_M;
  std::uint32_t node_N;
  PairMask pairs;
};

/// The next step of a traversal from a pair of children.
struct Descent {
  NodePair next;       ///< two nodes, or two leaves if both children are leaves
  bool is_leaf;        ///< `next` has two leaves
  PairMask including;  ///< the pairs of children that this step covers
};

/// The two leaves of the last visit: often the next visit has one of them again. Valid within one query.
struct VisitedLeaves : LeafPair {
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::uint32_t leaf_M = kNone;
  std::uint32_t leaf_N = kNone;
  PairMask selected = kAllPairs;

  /// Triangle pairs that exist and are selected.
  PairMask of_interest() const { return present() & selected; }
};

/// Compares nodes and leaves of two trees in one frame.
class DopVisit {
 public:
  /// Drops pairs that are certainly farther apart than `distance` (metres), and pairs without a selected triangle.
  /// `alignment` is scratch memory. `meter` may be null.
  DopVisit(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance, DopAlignment& alignment,
           const VisitSelection& selection = {}, WorkMeter* meter = nullptr);

  /// Whether the oriented bounding boxes of both trees are certainly farther apart than the distance.
  bool boxes_apart() const;

  /// The pairs of `pair` in which both children exist and a triangle is selected.
  PairMask pairs_of(const NodePair& pair) const;

  /// The pairs of children whose boxes may be near. Sets the overlaps of all pairs, in grid steps of the base.
  PairMask nodes(const NodePair& pair, PairOverlaps& overlaps, QueryCounters& counters);

  /// Sets lower bounds of the distances of all pairs of children. With `is_far`, only those along the first direction
  /// of the last frame.
  void bounds(const NodePair& pair, const std::array<BoxFrame, kBoxFrames>& frames, bool is_far, DistanceBounds& bounds,
              QueryCounters& counters);

  /// The pairs of `near` without those that thin slabs separate. Tests the pairs in which both children have a thin
  /// slab, and lowers their overlaps.
  PairMask thin_slabs(const NodePair& pair, PairMask near, PairOverlaps& overlaps) const;

  /// Prefetches all children with a pair in the mask. Without this, visits would wait for one after another.
  void prefetch(const NodePair& pair, PairMask near) const;

  /// A pair of children in the mask, which must not be 0, whose overlap is about the greatest.
  int deepest(const PairOverlaps& overlaps, PairMask pairs) const { return node_kernels_.deepest(overlaps, pairs); }

  /// The next step from one pair of children. If one child is a leaf, or much smaller than the other, only the other is
  /// opened, at once for all such children that are paired with it in `near`.
  Descent descend(const NodePair& nodes, PairMask near, int pair) const;

  /// Transforms two leaves into one frame for the functions below.
  void prepare(std::uint32_t leaf_M, std::uint32_t leaf_N, VisitedLeaves& leaves);

  /// A certain lower bound of the distance of two whole leaves, in radii of the base; may be negative.
  double leaf_gap(const LeafPair& leaves, QueryCounters& counters) const;

  /// The selected triangle pairs that no normal certainly separates by more than the distance.
  PairMask leaves(VisitedLeaves& leaves, QueryCounters& counters) const;

  /// Raises the gaps of all triangle pairs to those along a direction of about unit length, in the frame of M.
  void along(const std::array<float, 3>& direction, LeafPair& leaves) const {
    leaf_kernels_.along(*leaf_frame_, direction, leaves);
  }

  /// The triangle pairs that certainly intersect, and those that certainly do not. Both sets are empty for a distance
  /// greater than 0.
  CertainPairs cross(const LeafPair& leaves) const;

  /// The pairs in the mask that `LeafKernels::edges` does not certainly separate by more than the distance. Raises
  /// their gaps. These pairs are then tested exactly, which counts as work here.
  PairMask edges(LeafPair& leaves, PairMask pairs) const;

  /// The same, and sets the directions of the pairs that it returns. Those of them that are tested exactly all the same
  /// count with `spend_on_tests`.
  PairMask edges_and_directions(LeafPair& leaves, PairMask pairs) const;
  void spend_on_tests(PairMask pairs) const;

  /// The least known gap of the triangle pairs in the mask, in radii of the base; 1e30 for an empty mask.
  double least_gap(const LeafPair& leaves, PairMask pairs) const;

  /// The least gap of the pairs of children in the mask, which must not be 0, in radii of the base.
  double least_gap(const PairOverlaps& overlaps, PairMask pairs) const;

  /// Whether the distance is greater than 0. If it is 0, the exact predicate costs no more than `edges`.
  bool has_distance() const { return distance_ > 0.0F; }

  /// Whether a gap (radii of the base) is greater than the distance.
  bool beyond(double gap) const { return gap > static_cast<double>(distance_); }

 private:
  PairMask realign_and_test(const NodePair& pair, PairOverlaps& overlaps) const;
  void spend(std::int64_t work) const {
    if (meter_ != nullptr) meter_->spend(work);
  }

  void begin_nodes();

  /// The nodes of a pair of children that the next step opens.
  enum class Opened { kNeither, kM, kN, kBoth };
  Opened opened(const NodeHead& head_M, int p, const NodeHead& head_N, int q) const;

  const DopTree& base_;
  const DopTree& other_;
  const QueryFrame& frame_;
  DopAlignment& alignment_;
  const VisitSelection selection_;
  WorkMeter* meter_;
  std::optional<ThinSlabFrame> thin_frame_;          ///< set by the first visit of nodes, which may never come
  std::optional<VertexAlignment> vertex_alignment_;  ///< the same, for realignment by brute force
  std::optional<LeafFrame> leaf_frame_;              ///< set by the first visit of leaves
  const NodeKernels& node_kernels_;
  const LeafKernels& leaf_kernels_;
  const float ratio_;  ///< one grid step of N in grid steps of M
  int least_overlap_;
  PairMask always_near_;  ///< all pairs if the distance exceeds the range of 16 bits
  float distance_;
};

inline Descent DopVisit::descend(const NodePair& nodes, PairMask near, int pair) const {
  const NodeHead& head_M = nodes_of(base_)[nodes.node_M];
  const NodeHead& head_N = nodes_of(other_)[nodes.node_N];
  const int p = pair / kWidth;
  const int q = pair % kWidth;
  const auto is_opened = [&](int child_M, int child_N) { return opened(head_M, child_M, head_N, child_N); };
  const Opened which = is_opened(p, q);
  if (which == Opened::kBoth) return {{head_M.child(p), head_N.child(q), kAllPairs}, false, row_of(p) & column_of(q)};
  if (which == Opened::kNeither) {
    return {{head_M.child(p), head_N.child(q), kAllPairs}, true, row_of(p) & column_of(q)};
  }
  PairMask alike = 0;  // children that stay closed while the same child is opened
  if (which == Opened::kN) {
    for (int c = 0; c < kWidth; ++c)
      alike |= (near & row_of(c) & column_of(q)) != 0 && is_opened(c, q) == which ? row_of(c) & column_of(q) : 0;
    return {{nodes.node_M, head_N.child(q), (alike >> q) * row_of(0)}, false, alike};
  }
  for (int c = 0; c < kWidth; ++c)
    alike |= (near & row_of(p) & column_of(c)) != 0 && is_opened(p, c) == which ? row_of(p) & column_of(c) : 0;
  return {{head_M.child(p), nodes.node_N, (alike >> (kWidth * p)) * column_of(0)}, false, alike};
}

inline DopVisit::Opened DopVisit::opened(const NodeHead& head_M, int p, const NodeHead& head_N, int q) const {
  // A child that is this many times as large as the other is opened alone: opening a small one beside it would multiply
  // pairs without bringing boxes apart.
  constexpr float kMuchLarger = 3.0F;
  const bool is_leaf_M = head_M.is_leaf(p);
  const bool is_leaf_N = head_N.is_leaf(q);
  if (is_leaf_M || is_leaf_N) {
    return is_leaf_M == is_leaf_N ? Opened::kNeither : is_leaf_M ? Opened::kN : Opened::kM;
  }
  const float radius_M = head_M.radius[static_cast<std::size_t>(p)];
  const float radius_N = ratio_ * head_N.radius[static_cast<std::size_t>(q)];
  if (radius_M > kMuchLarger * radius_N) return Opened::kM;
  return radius_N > kMuchLarger * radius_M ? Opened::kN : Opened::kBoth;
}

}  // namespace glissade::collision
