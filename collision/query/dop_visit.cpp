#include "query/dop_visit.h"

#include <algorithm>
#include <bit>

#include <glissade/base/assert.h>

#include "kernels/prefetch.h"
#include "kernels/round_up.h"
#include "query/oriented_boxes.h"
#include "tree/dop.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

// Work of a pair of nodes, of leaves, of the directions of its triangle pairs, and of the distance of one: about
// nanoseconds, rather more than less: memory that grows and pairs that are sorted take their time too.
constexpr std::int64_t kWorkOfNodes = 100;
constexpr std::int64_t kWorkOfLeaves = 100;
constexpr std::int64_t kWorkOfDirections = 500;
constexpr std::int64_t kWorkOfTriangles = 500;

// All pairs of a child of M in one set and a child of N in the other.
PairMask product(std::uint32_t children_M, std::uint32_t children_N) {
  return rows_of(children_M) & columns_of(children_N);
}

void prefetch_child(const DopTree& tree, std::uint32_t node, int c) {
  const NodeHead& head = nodes_of(tree)[node];
  if (head.is_leaf(c)) {
    prefetch_lines(&leaves_of(tree)[head.child(c)], sizeof(TriangleLeaf));
  } else {
    prefetch_node(tree, head.child(c));
  }
}

std::uint32_t all_children(const NodeHead& head) {
  return (1U << head.child_count()) - 1U;
}

}  // namespace

DopVisit::DopVisit(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance,
                   DopAlignment& alignment, const VisitSelection& selection, WorkMeter* meter)
    : base_(base),
      other_(other),
      frame_(frame),
      alignment_(alignment),
      selection_(selection),
      meter_(meter),
      node_kernels_(node_kernels()),
      leaf_kernels_(leaf_kernels()),
      ratio_(static_cast<float>(frame.ratio)) {
  const double radii = frame.in_base_radii(distance);
  const double steps = std::min(radii * kGridRadius, 32768.0);
  const int whole_steps = static_cast<int>(steps) + (static_cast<int>(steps) < steps ? 1 : 0);
  always_near_ = whole_steps > 32767 ? kAllPairs : 0;
  least_overlap_ = -std::min(whole_steps, 32767);
  distance_ = round_up_to_float(std::min(radii, 1e30));
}

void DopVisit::begin_nodes() {
  thin_frame_.emplace(frame_);
  const int k = base_.options().directions;
  if (base_.options().realignment == Realignment::kBruteForce) {
    vertex_alignment_.emplace(dop_directions(k), frame_);
  } else {
    align(k, frame_, alignment_);
  }
}

bool DopVisit::boxes_apart() const {
  return collision::boxes_apart(base_, other_, frame_, static_cast<double>(distance_));
}

PairMask DopVisit::pairs_of(const NodePair& pair) const {
  return pair.pairs & product(all_children(nodes_of(base_)[pair.node_M]), all_children(nodes_of(other_)[pair.node_N])) &
         selection_.pairs_of_nodes(pair.node_M, pair.node_N);
}

PairMask DopVisit::nodes(const NodePair& pair, PairOverlaps& overlaps, QueryCounters& counters) {
  const PairMask pairs = pairs_of(pair);
  if (pairs == 0) return 0;  // happens at the roots only, if nothing is selected
  if (!thin_frame_) begin_nodes();
  const int children_N = nodes_of(other_)[pair.node_N].child_count();
  counters.realignments += children_N;
  counters.node_tests += nodes_of(base_)[pair.node_M].child_count() * children_N;
  spend(kWorkOfNodes);
  return pairs & (always_near_ | realign_and_test(pair, overlaps));
}

void DopVisit::bounds(const NodePair& pair, const std::array<BoxFrame, kBoxFrames>& frames, bool is_far,
                      DistanceBounds& bounds, QueryCounters& counters) {
  const NodeHead& head_M = nodes_of(base_)[pair.node_M];
  const NodeHead& head_N = nodes_of(other_)[pair.node_N];
  const SlabLine* slabs_M = slabs_of(base_, pair.node_M);
  const SlabLine* slabs_N = slabs_of(other_, pair.node_N);
  const int slabs = dop_directions(base_.options().directions).slabs;
  counters.realignments += head_M.child_count() + head_N.child_count();
  counters.node_tests += head_M.child_count() * head_N.child_count();
  spend(kWorkOfNodes);
  const BoundedNode node_M{head_M, slabs_M};
  const BoundedNode node_N{head_N, slabs_N};
  if (is_far) return bound_along(frames.back(), node_M, node_N, slabs, bounds);
  bound_distances(frames, node_M, node_N, slabs, bounds);
  const PairMask thin = pair.pairs & product(head_M.thin, head_N.thin);
  if (thin == 0) return;
  if (!thin_frame_) thin_frame_.emplace(frame_);
  PairOverlaps overlaps;
  overlaps.overlap.fill(32767);
  node_kernels_.test_thin(*thin_frame_, head_M, slabs_M, head_N, slabs_N, 0, overlaps);
  for (PairMask rest = thin; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rest));
    bounds.bound[i] = std::max(bounds.bound[i], -static_cast<float>(overlaps.overlap[i]) / kGridRadius);
  }
}

PairMask DopVisit::realign_and_test(const NodePair& pair, PairOverlaps& overlaps) const {
  const SlabLine* slabs_M = slabs_of(base_, pair.node_M);
  if (!vertex_alignment_) {
    return node_kernels_.realign_and_test(alignment_, slabs_M, slabs_of(other_, pair.node_N), least_overlap_, overlaps);
  }
  AlignedNode aligned;
  realign_vertices()(*vertex_alignment_, vertices_of(other_, pair.node_N), aligned);
  return node_kernels_.test(slabs_M, aligned, vertex_alignment_->slabs, least_overlap_, overlaps);
}

PairMask DopVisit::thin_slabs(const NodePair& pair, PairMask near, PairOverlaps& overlaps) const {
  const NodeHead& head_M = nodes_of(base_)[pair.node_M];
  const NodeHead& head_N = nodes_of(other_)[pair.node_N];
  const PairMask thin = near & product(head_M.thin, head_N.thin);
  if (thin == 0) return near;
  return near & (~thin | always_near_ |
                 node_kernels_.test_thin(*thin_frame_, head_M, slabs_of(base_, pair.node_M), head_N,
                                         slabs_of(other_, pair.node_N), least_overlap_, overlaps));
}

void DopVisit::prefetch(const NodePair& pair, PairMask near) const {
  for (int c = 0; c < kWidth; ++c) {
    if ((near & row_of(c)) != 0) prefetch_child(base_, pair.node_M, c);
    if ((near & column_of(c)) != 0) prefetch_child(other_, pair.node_N, c);
  }
}

void DopVisit::prepare(std::uint32_t leaf_M, std::uint32_t leaf_N, VisitedLeaves& leaves) {
  if (!leaf_frame_) leaf_frame_.emplace(frame_);
  if (leaves.leaf_M != leaf_M) leaf_kernels_.prepare_M(leaves_of(base_)[leaf_M], leaves);
  if (leaves.leaf_N != leaf_N) leaf_kernels_.prepare_N(*leaf_frame_, leaves_of(other_)[leaf_N], leaves);
  leaves.leaf_M = leaf_M;
  leaves.leaf_N = leaf_N;
  leaves.selected = selection_.pairs_of_leaves(leaf_M, leaf_N);
}

double DopVisit::leaf_gap(const LeafPair& leaves, QueryCounters& counters) const {
  counters.triangle_tests += kWidth * kWidth;
  spend(kWorkOfLeaves);
  return static_cast<double>(leaf_kernels_.leaf_gap(*leaf_frame_, leaves));
}

PairMask DopVisit::leaves(VisitedLeaves& leaves, QueryCounters& counters) const {
  counters.triangle_tests += kWidth * kWidth;
  spend(kWorkOfLeaves);
  return leaves.selected & leaf_kernels_.test(*leaf_frame_, distance_, leaves);
}

CertainPairs DopVisit::cross(const LeafPair& leaves) const {
  return has_distance() ? CertainPairs{} : leaf_kernels_.cross(*leaf_frame_, leaves);
}

PairMask DopVisit::edges(LeafPair& leaves, PairMask pairs) const {
  const PairMask near = leaf_kernels_.edges(*leaf_frame_, distance_, pairs, leaves);
  spend_on_tests(near);
  return near;
}

PairMask DopVisit::edges_and_directions(LeafPair& leaves, PairMask pairs) const {
  spend(kWorkOfDirections);
  return leaf_kernels_.edges_and_directions(*leaf_frame_, distance_, pairs, leaves);
}

void DopVisit::spend_on_tests(PairMask pairs) const {
  spend(kWorkOfTriangles * std::popcount(pairs));
}

double DopVisit::least_gap(const LeafPair& leaves, PairMask pairs) const {
  return static_cast<double>(leaf_kernels_.least_gap(leaves, pairs));
}

double DopVisit::least_gap(const PairOverlaps& overlaps, PairMask pairs) const {
  GLISSADE_ASSERT(pairs != 0);
  return -node_kernels_.most_overlap(overlaps, pairs) / static_cast<double>(kGridRadius);
}

}  // namespace glissade::collision
