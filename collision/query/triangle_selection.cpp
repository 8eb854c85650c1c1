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

}  // namespace

TriangleSelection::TriangleSelection(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected)
    : nodes_(nodes_of(tree).size()), leaves_(leaves_of(tree).size()) {
  if (!is_selected) throw std::invalid_argument("a selection of triangles needs a function that selects them");
  static std::atomic<std::uint64_t> ids{0};
  id_ = ++ids;
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf)
    leaves_[leaf] = selected_of(leaves_of(tree)[leaf], is_selected);
  // Nodes come after their parents.
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    const NodeHead& head = nodes_of(tree)[node];
    unsigned mask = 0;
    for (int c = 0; c < head.child_count(); ++c) {
      const std::uint32_t child = head.child(c);
      if ((head.is_leaf(c) ? leaves_ : nodes_)[child] != 0) mask |= 1U << c;
    }
    nodes_[node] = static_cast<std::uint8_t>(mask);
  }
}

bool TriangleSelection::is_of(const DopTree& tree) const {
  return nodes_.size() == nodes_of(tree).size() && leaves_.size() == leaves_of(tree).size();
}

}  // namespace glissade::collision
