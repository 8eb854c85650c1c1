#include <atomic>
#include <stdexcept>

#include <glissade/collision/query_types.h>

#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

std::uint8_t selected_of(const TriangleLeaf& leaf, const std::function<bool(std::int32_t)>& is_selected) {
  unsigned mask = 0;
  for (unsigned t = 0; t < kWidth; ++t) {
    std::int32_t triangle = leaf.triangle[t];
    if (triangle == kNoTriangle) continue;
    if (triangle < 0) triangle = -1 - triangle;  // without area now; a refit may change that
    if (is_selected(triangle)) mask |= 1U << t;
  }
  return static_cast<std::uint8_t>(mask);
}

TriangleSelection::Marks marks_of(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected) {
  TriangleSelection::Marks marks;
  marks.nodes.resize(nodes_of(tree).size());
  marks.leaves.resize(leaves_of(tree).size());
  for (std::size_t leaf = 0; leaf < marks.leaves.size(); ++leaf)
    marks.leaves[leaf] = selected_of(leaves_of(tree)[leaf], is_selected);
  // Nodes come after their parents.
  for (std::size_t node = marks.nodes.size(); node-- > 0;) {
    const NodeHead& head = nodes_of(tree)[node];
    unsigned mask = 0;
    for (int c = 0; c < head.child_count(); ++c) {
      const std::uint32_t child = head.child(c);
      if ((head.is_leaf(c) ? marks.leaves : marks.nodes)[child] != 0) mask |= 1U << c;
    }
    marks.nodes[node] = static_cast<std::uint8_t>(mask);
  }
  return marks;
}

/// All children of a node, or triangles of a leaf.
std::uint8_t all_of(const NodeHead& head) {
  return static_cast<std::uint8_t>((1U << static_cast<unsigned>(head.child_count())) - 1U);
}
std::uint8_t all_of(const TriangleLeaf& leaf) {
  return selected_of(leaf, [](std::int32_t) { return true; });
}

/// For each node, the children below which everything is marked.
std::vector<std::uint8_t> whole_children(const DopTree& tree, const TriangleSelection::Marks& marks) {
  std::vector<std::uint8_t> whole(marks.nodes.size());
  for (std::size_t node = whole.size(); node-- > 0;) {
    const NodeHead& head = nodes_of(tree)[node];
    unsigned mask = 0;
    for (int c = 0; c < head.child_count(); ++c) {
      const std::uint32_t child = head.child(c);
      const bool is_whole = head.is_leaf(c) ? marks.leaves[child] == all_of(leaves_of(tree)[child])
                                            : whole[child] == all_of(nodes_of(tree)[child]);
      if (is_whole) mask |= 1U << c;
    }
    whole[node] = static_cast<std::uint8_t>(mask);
  }
  return whole;
}

/// Adds the marks of `others`.
void add(const std::vector<std::uint8_t>& others, std::vector<std::uint8_t>& marks) {
  for (std::size_t i = 0; i < marks.size(); ++i)
    marks[i] = static_cast<std::uint8_t>(marks[i] | others[i]);
}

}  // namespace

TriangleSelection::TriangleSelection(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected,
                                     const std::function<bool(std::int32_t)>& is_half_selected) {
  if (!is_selected) throw std::invalid_argument("a selection of triangles needs a function that selects them");
  static std::atomic<std::uint64_t> ids{0};
  id_ = ++ids;
  selected_ = marks_of(tree, is_selected);
  at_least_half_ = selected_;
  if (is_half_selected) {
    const Marks half = marks_of(tree, is_half_selected);
    add(half.nodes, at_least_half_.nodes);
    add(half.leaves, at_least_half_.leaves);
  }
  whole_children_ = collision::whole_children(tree, at_least_half_);
}

bool TriangleSelection::is_of(const DopTree& tree) const {
  return selected_.nodes.size() == nodes_of(tree).size() && selected_.leaves.size() == leaves_of(tree).size();
}

}  // namespace glissade::collision
