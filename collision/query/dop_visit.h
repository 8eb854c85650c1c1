#pragma once

/// One step of a traversal: two nodes, or two leaves, of one pair of trees.

#include <cstdint>
#include <optional>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>

#include "kernels/dop_alignment.h"
#include "kernels/leaf_kernels.h"
#include "kernels/node_kernels.h"
#include "kernels/query_frame.h"
#include "kernels/thin_slab.h"
#include "kernels/vertex_alignment.h"
#include "query/visit_selection.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// Two nodes to be compared, and which pairs of their children. Where one tree ends above the other, its leaf stays a
/// child of the node it belongs to, and fewer pairs are of interest.
struct NodePair {
  std::uint32_t node_M;
  std::uint32_t node_N;
  PairMask pairs;
};

/// Where a traversal goes from a pair of children.
struct Descent {
  NodePair next;       ///< nodes, or leaves if both children are
  bool is_leaf;        ///< both are
  PairMask including;  ///< the pairs of children that this takes care of
};

/// The two leaves of the last visit; often the next one has one of them again. Of one query only.
struct VisitedLeaves : LeafPair {
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::uint32_t leaf_M = kNone;
  std::uint32_t leaf_N = kNone;
  PairMask selected = kAllPairs;

  /// Pairs of triangles that the query is after.
  PairMask of_interest() const { return present() & selected; }
};

/// Compares nodes and leaves of two trees in one frame.
class DopVisit {
 public:
  /// Pairs that are certainly further apart than `distance` (metres) are dropped, and those that have nothing of the
  /// selection. `alignment` is scratch memory.
  DopVisit(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance, DopAlignment& alignment,
           const VisitSelection& selection = {});

  /// The bounding boxes of both trees, turned as these are, are certainly further apart than the distance.
  bool boxes_apart() const;

  /// The pairs of children there are, among those of interest, with something selected.
  PairMask pairs_of(const NodePair& pair) const;

  /// The pairs of children whose boxes may be near; `overlaps` of all pairs, in grid steps of the base.
  PairMask nodes(const NodePair& pair, PairOverlaps& overlaps, QueryCounters& counters);

  /// Those of the pairs `near` whose thin slabs may be near too, where both have one; lowers their overlaps.
  PairMask thin_slabs(const NodePair& pair, PairMask near, PairOverlaps& overlaps) const;

  /// Has the memory ready soon of all children with a pair in the mask: they would be waited for one by one.
  void prefetch(const NodePair& pair, PairMask near) const;

  /// Of the pairs of children in the mask, which is not 0, one that overlaps about most.
  int deepest(const PairOverlaps& overlaps, PairMask pairs) const { return node_kernels_.deepest(overlaps, pairs); }

  /// The descent from one pair of children. Where a leaf meets a node, the node is opened, for all leaves that meet it
  /// according to `near`.
  Descent descend(const NodePair& nodes, PairMask near, int pair) const;

  /// Brings two leaves together for the functions below.
  void prepare(std::uint32_t leaf_M, std::uint32_t leaf_N, VisitedLeaves& leaves);

  /// A certain lower bound of the distance of two leaves as a whole, in radii of the base; may be negative.
  double leaf_gap(const LeafPair& leaves, QueryCounters& counters) const;

  /// The pairs of triangles that their normals may let be near.
  PairMask leaves(VisitedLeaves& leaves, QueryCounters& counters) const;

  /// Of those, the ones that certainly intersect, and the ones that certainly do not. Nothing is certain when pairs
  /// within a distance are looked for.
  CertainPairs cross(const LeafPair& leaves) const;

  /// Of the pairs in the mask, those that cross products of edges do not certainly keep further apart than the distance
  /// looked for; raises their gaps.
  PairMask edges(LeafPair& leaves, PairMask pairs) const;

  /// The least gap that is known of some pairs of triangles, in radii of the base; 1e30 of none.
  double least_gap(const LeafPair& leaves, PairMask pairs) const;

  /// The same of some pairs of children, which must not be none, in radii of the base.
  double least_gap(const PairOverlaps& overlaps, PairMask pairs) const;

  /// Whether pairs further apart than 0 are looked for. If not, the predicate costs no more than the edges.
  bool has_distance() const { return distance_ > 0.0F; }

  /// Whether a gap is more than the distance looked for.
  bool beyond(double gap) const { return gap > static_cast<double>(distance_); }

 private:
  PairMask realign_and_test(const NodePair& pair, PairOverlaps& overlaps) const;

  void begin_nodes();

  const DopTree& base_;
  const DopTree& other_;
  const QueryFrame& frame_;
  DopAlignment& alignment_;
  const VisitSelection selection_;
  std::optional<ThinSlabFrame> thin_frame_;          ///< once a node is visited: some coherent queries see leaves only
  std::optional<VertexAlignment> vertex_alignment_;  ///< the same, for realignment by brute force
  std::optional<LeafFrame> leaf_frame_;              ///< once a leaf is
  const NodeKernels& node_kernels_;
  const LeafKernels& leaf_kernels_;
  int least_overlap_;
  PairMask always_near_;  ///< all pairs when the distance goes beyond what 16 bits can tell
  float distance_;
};

inline Descent DopVisit::descend(const NodePair& nodes, PairMask near, int pair) const {
  const NodeHead& head_M = base_.nodes()[nodes.node_M];
  const NodeHead& head_N = other_.nodes()[nodes.node_N];
  const int p = pair / kWidth;
  const int q = pair % kWidth;
  if (head_M.is_leaf(p) == head_N.is_leaf(q)) {
    return {{head_M.child(p), head_N.child(q), kAllPairs}, head_M.is_leaf(p), row_of(p) & column_of(q)};
  }
  if (head_M.is_leaf(p)) {
    const PairMask leaves = near & column_of(q) & (kAllPairs << (kWidth * head_M.node_count));
    return {{nodes.node_M, head_N.child(q), (leaves >> q) * row_of(0)}, false, leaves};
  }
  const PairMask leaves = near & row_of(p) & ((0xfU >> head_N.node_count << head_N.node_count) * column_of(0));
  return {{head_M.child(p), nodes.node_N, (leaves >> (kWidth * p)) * column_of(0)}, false, leaves};
}

}  // namespace glissade::collision
