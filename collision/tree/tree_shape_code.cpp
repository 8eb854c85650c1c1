#include "tree/tree_shape_code.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <glissade/base/byte_order.h>

#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

// Bounds the recursion over nodes, here and in the fit of boxes. Built trees have a tenth of this depth.
constexpr int kMostDepth = 256;

constexpr std::size_t kCountsSize = 8;

void require(bool holds, const char* otherwise) {
  if (!holds) throw std::invalid_argument(otherwise);
}

std::int32_t triangle_of(std::int32_t entry) {
  return entry < 0 ? -1 - entry : entry;
}

std::size_t triangle_count(const TriangleLeaf& leaf) {
  return static_cast<std::size_t>(std::find(leaf.triangle.begin(), leaf.triangle.end(), kNoTriangle) -
                                  leaf.triangle.begin());
}

// Links the nodes of a shape, whose numbers of nodes and leaves are set, by the numbers of their children.
class Linking {
 public:
  Linking(std::string_view children, TreeShape& shape) : children_(children), shape_(shape) {}

  void link_all() {
    link(0, 0);
    require(next_node_ == shape_.nodes.size() && next_leaf_ == shape_.leaves.size(), "parts that belong to no node");
  }

 private:
  void link(std::size_t node, int depth) {
    require(depth <= kMostDepth, "nodes too deep");
    shape_.depth = std::max(shape_.depth, depth);
    const auto code = static_cast<std::uint8_t>(children_[node]);
    NodeHead head{};
    head.node_count = static_cast<std::uint8_t>(code >> 4U);
    head.leaf_count = static_cast<std::uint8_t>(code & 15U);
    // A node has one child only in a tree of one leaf. Elsewhere, only children would let nodes outnumber triangles.
    const bool is_single_leaf = node == 0 && code == 1;
    require(is_single_leaf || (head.child_count() >= 2 && head.child_count() <= kWidth), "a wrong number of children");
    head.first_leaf = static_cast<std::uint32_t>(next_leaf_);
    head.first_node = static_cast<std::uint32_t>(next_node_);
    next_leaf_ += head.leaf_count;
    next_node_ += head.node_count;
    require(next_leaf_ <= shape_.leaves.size() && next_node_ <= shape_.nodes.size(), "more children than parts");
    shape_.nodes[node] = head;
    for (std::size_t child = head.first_node; child < std::size_t{head.first_node} + head.node_count; ++child)
      link(child, depth + 1);
  }

  const std::string_view children_;
  TreeShape& shape_;
  std::size_t next_node_ = 1;
  std::size_t next_leaf_ = 0;
};

void fill_leaves(std::string_view sizes, std::string_view triangles, std::size_t triangle_count, TreeShape& shape) {
  std::vector<bool> is_known(triangle_count, false);
  std::size_t next = 0;
  for (std::size_t l = 0; l < shape.leaves.size(); ++l) {
    TriangleLeaf& leaf = shape.leaves[l];
    leaf.triangle.fill(kNoTriangle);
    const auto size = static_cast<std::uint8_t>(sizes[l]);
    require(size >= 1 && size <= kWidth && size <= triangle_count - next, "a wrong number of triangles");
    for (std::size_t t = 0; t < size; ++t, ++next) {
      const auto triangle = base::number_at<std::uint32_t>(triangles, 4 * next);
      require(triangle < triangle_count && !is_known[triangle], "triangles that are not each one once");
      is_known[triangle] = true;
      leaf.triangle[t] = static_cast<std::int32_t>(triangle);
    }
  }
  require(next == triangle_count, "a wrong number of triangles");
}

}  // namespace

void append_shape_code(const DopTree& tree, std::string& bytes) {
  base::append_number(bytes, static_cast<std::uint32_t>(nodes_of(tree).size()));
  base::append_number(bytes, static_cast<std::uint32_t>(leaves_of(tree).size()));
  for (const NodeHead& head : nodes_of(tree))
    base::append_number(bytes, static_cast<std::uint8_t>(head.node_count << 4U | head.leaf_count));
  for (const TriangleLeaf& leaf : leaves_of(tree))
    base::append_number(bytes, static_cast<std::uint8_t>(triangle_count(leaf)));
  for (const TriangleLeaf& leaf : leaves_of(tree)) {
    for (std::size_t t = 0; t < triangle_count(leaf); ++t)
      base::append_number(bytes, static_cast<std::uint32_t>(triangle_of(leaf.triangle[t])));
  }
}

std::size_t longest_shape_code(std::size_t triangles) {
  return kCountsSize + 6 * triangles;
}

TreeShape decode_shape(std::string_view bytes, std::size_t triangles) {
  require(bytes.size() >= kCountsSize, "truncated");
  const std::size_t nodes = base::number_at<std::uint32_t>(bytes, 0);
  const std::size_t leaves = base::number_at<std::uint32_t>(bytes, 4);
  require(nodes >= 1 && nodes <= triangles && leaves <= triangles, "too many parts");
  require(bytes.size() == kCountsSize + nodes + leaves + 4 * triangles, "a wrong length");
  bytes.remove_prefix(kCountsSize);

  TreeShape shape;
  shape.nodes.resize(nodes);
  shape.leaves.resize(leaves);
  Linking(bytes.substr(0, nodes), shape).link_all();
  fill_leaves(bytes.substr(nodes, leaves), bytes.substr(nodes + leaves), triangles, shape);
  return shape;
}

}  // namespace glissade::collision
