#pragma once

/// The DOP-tree: a bounding-volume hierarchy of discretely oriented polytopes over a triangle soup (paper §2.1). Build
/// one tree for each mesh. Objects and threads may share a tree. The queries of `dop_query.h` take two trees. In all
/// names and comments, "node" means an inner node of a tree. Leaves are not nodes.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::collision {

struct NodeHead;
struct SlabLine;
struct TriangleLeaf;
struct TreeNodes;
struct TreeShape;
class DopVertices;

/// How a query encloses the nodes of one tree in DOPs aligned to the other tree.
enum class Realignment {
  kAffine,      ///< computes each new plane offset from three old offsets: O(k) (paper §2.1, eq. 1)
  kBruteForce,  ///< projects every vertex of a node on every direction: O(k²) (paper §2.1.1)
};

/// Options of construction. The defaults are the fastest values. Other values are for comparisons.
struct DopTreeOptions {
  int directions = 24;  ///< k, the number of half-spaces: 6, 14, 18, 24 or 26
  /// Adds to each child a slab along the principal axis of its triangles' normals. A query tests the slab if the slab
  /// is less than half as thick as the thinnest slab of the child's DOP.
  bool thin_slab = true;
  Realignment realignment = Realignment::kAffine;

  bool operator==(const DopTreeOptions&) const = default;
};

/// The children of a node. Children that are nodes come first, then children that are leaves. Nodes and leaves of a
/// tree are numbered separately. The nodes among the children have consecutive numbers, and so have the leaves.
struct TreeNode {
  std::uint32_t first_node;  ///< number of the first child that is a node
  std::uint32_t first_leaf;  ///< number of the first child that is a leaf
  int node_count;
  int leaf_count;

  int child_count() const { return node_count + leaf_count; }
  bool is_leaf(int child) const { return child >= node_count; }
  /// The number of child c: a node number or, if `is_leaf(c)`, a leaf number.
  std::uint32_t child(int c) const {
    return is_leaf(c) ? first_leaf + static_cast<std::uint32_t>(c - node_count)
                      : first_node + static_cast<std::uint32_t>(c);
  }
};

/// A bounding-volume hierarchy in the object's own frame. Nodes have up to four children, and leaves have up to four
/// triangles.
///
/// Thread-safety: any number of threads may query a tree at once. During `refit`, no other thread may use the tree.
class DopTree {
 public:
  /// Maximum number of children of a node, and of triangles of a leaf.
  static constexpr int kWidth = 4;

  /// Builds the hierarchy by a binned surface-area heuristic, with several threads if the mesh is large. The result
  /// does not depend on the number of threads. Degenerate triangles (zero area) take part in no query.
  ///
  /// Throws std::invalid_argument for:
  /// - a null mesh
  /// - a mesh without a triangle of positive area
  /// - more than 5 million triangles
  /// - an index out of range
  /// - a coordinate that is not finite or beyond ±1e9
  /// - an unsupported number of directions
  ///
  /// Cost O(n log n).
  explicit DopTree(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const DopTreeOptions& options = {});
  DopTree(const DopTree& other);
  DopTree(DopTree&&) noexcept;
  DopTree& operator=(const DopTree& other);
  DopTree& operator=(DopTree&&) noexcept;
  ~DopTree();

  /// Fits all DOPs to the present vertices. Call this after moving vertices of the mesh. The vertex indices of
  /// triangles must be unchanged. Queries stay exact, but become slower if triangles below a node have moved apart.
  /// Allocates nothing. Cost O(n log n). Throws std::invalid_argument for a coordinate that the constructor would
  /// reject; the tree is then unchanged.
  void refit();

  const geometry::TriangleMesh& mesh() const { return *mesh_; }
  const DopTreeOptions& options() const { return options_; }

  std::size_t node_count() const;
  std::size_t leaf_count() const;
  /// The node with this number, which must be below `node_count`. Node 0 is the root, which has at least one child.
  TreeNode node(std::uint32_t number) const;
  /// The triangles (indices into the mesh) of the leaf with this number, which must be below `leaf_count`. A negative
  /// entry stands for an unused place or for a triangle without area.
  std::span<const std::int32_t, kWidth> triangles_of_leaf(std::uint32_t leaf) const;

  /// A number that identifies the tree and its fit. The number is unique in this process and never 0. Construction and
  /// each `refit` assign a new number. A copy has the number of the original.
  std::uint64_t id() const { return id_; }

  std::int64_t degenerate_triangles() const { return degenerate_triangles_; }
  /// Number of levels of nodes below the root. Leaves do not count.
  int depth() const { return depth_; }
  /// Centre of the axis-aligned bounding box, and radius of a sphere about this centre that encloses every vertex
  /// (metres).
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }
  /// 1 / radius.
  double inverse_radius() const { return inverse_radius_; }
  /// Half of each edge length of the bounding box (metres), rounded up.
  const Eigen::Vector3d& half_size() const { return half_size_; }

  /// Bytes of the tree itself, without the shared mesh.
  std::size_t memory_bytes() const;

 private:
  friend struct TreeNodes;
  friend DopTree tree_of_shape(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options,
                               TreeShape&& shape);
  DopTree(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options, TreeShape&& shape);

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  DopTreeOptions options_;
  std::vector<NodeHead> heads_;
  std::vector<SlabLine> slabs_;
  std::unique_ptr<DopVertices> vertices_;  // only with Realignment::kBruteForce
  std::vector<TriangleLeaf> leaves_;
  std::size_t lines_of_node_ = 0;  // cache lines of slabs for each node, after its head
  std::uint64_t id_ = 0;
  std::int64_t degenerate_triangles_ = 0;
  int depth_ = 0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_size_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double inverse_radius_ = 0.0;
};

}  // namespace glissade::collision
