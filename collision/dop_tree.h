#pragma once

/// The DOP-tree: a hierarchy of discretely oriented polytopes over a triangle soup (paper §2.1).
/// Build one per mesh, share it between objects and threads, and query pairs of them with `dop_query.h`.

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
struct TreeShape;
struct VertexGroup;
class DopVertices;

/// How the nodes of one tree are brought into the frame of the other.
enum class Realignment {
  kAffine,      ///< three old offsets make a new one: O(k) (paper §2.1, eq. 1)
  kBruteForce,  ///< every vertex of the node is projected on every direction: O(k²) (paper §2.1.1)
};

/// What to build. The defaults are the fastest; the others are there to be compared with.
struct DopTreeOptions {
  int directions = 24;    ///< k: 6, 14, 18, 24 or 26
  bool thin_slab = true;  ///< an extra slab along a node's own thin direction, where that helps
  Realignment realignment = Realignment::kAffine;

  bool operator==(const DopTreeOptions&) const = default;
};

/// The children of a node: first those that are nodes, then those that are leaves; each kind is numbered consecutively.
struct TreeNode {
  std::uint32_t first_node;  ///< of the children that are nodes
  std::uint32_t first_leaf;  ///< of the children that are leaves
  int node_count;
  int leaf_count;

  int child_count() const { return node_count + leaf_count; }
  bool is_leaf(int child) const { return child >= node_count; }
  /// The number of a child among the nodes, or among the leaves.
  std::uint32_t child(int c) const {
    return is_leaf(c) ? first_leaf + static_cast<std::uint32_t>(c - node_count)
                      : first_node + static_cast<std::uint32_t>(c);
  }
};

/// A bounding-volume hierarchy in the object's own frame: nodes of four children, leaves of up to four triangles.
///
/// Thread-safety: any number of threads may query a tree at once; `refit` needs it alone.
class DopTree {
 public:
  /// Most children of a node, and most triangles of a leaf.
  static constexpr int kWidth = 4;

  /// Builds the hierarchy by binned surface-area heuristic, on several threads when the mesh is large; the result does
  /// not depend on their number. Degenerate triangles (zero area) take part in no query.
  ///
  /// Throws std::invalid_argument when the mesh is null, has no triangle of positive area or more than 5 million
  /// triangles, an index out of range, or a coordinate that is not finite or beyond ±1e9, and for options that do not
  /// exist.
  /// Cost O(n log n).
  explicit DopTree(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const DopTreeOptions& options = {});
  DopTree(const DopTree& other);
  DopTree(DopTree&&) noexcept;
  DopTree& operator=(const DopTree& other);
  DopTree& operator=(DopTree&&) noexcept;
  ~DopTree();

  /// Encloses the vertices where they are now, after the owner of the mesh has moved them; the triangles must be the
  /// same. Queries stay exact; they get slower the more neighbors have parted. Allocates nothing. Cost O(n log n).
  /// Throws std::invalid_argument, and leaves the tree as it was, for a coordinate the constructor would refuse.
  void refit();

  const geometry::TriangleMesh& mesh() const { return *mesh_; }
  const DopTreeOptions& options() const { return options_; }

  std::size_t node_count() const;
  std::size_t leaf_count() const;
  /// A node by its number, below `node_count`. Node 0 is the root; it has at least one child.
  TreeNode node(std::uint32_t number) const;
  /// The triangles of a leaf by its number, below `leaf_count`: numbers in the mesh, negative where there is none or it
  /// has no area.
  std::span<const std::int32_t, kWidth> triangles_of_leaf(std::uint32_t leaf) const;

  /// Another number for every tree and every refit of this process; 0 is none.
  std::uint64_t id() const { return id_; }

  std::int64_t degenerate_triangles() const { return degenerate_triangles_; }
  /// Levels of nodes below the root, leaves not counted.
  int depth() const { return depth_; }
  /// Centre of the bounding box and radius in metres of a sphere about it that holds every vertex of the tree.
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }
  /// One over it, for those who would divide often.
  double inverse_radius() const { return inverse_radius_; }
  /// Half the edges of the bounding box in metres, rounded up.
  const Eigen::Vector3d& half_size() const { return half_size_; }

  /// Bytes of the tree itself, without the mesh it shares.
  std::size_t memory_bytes() const;

  // Nodes and leaves as the kernels read them; their types are private (`tree/tree_nodes.h`).
  std::span<const NodeHead> nodes() const;
  const SlabLine* slabs(std::uint32_t node) const;
  std::span<const VertexGroup> vertices(std::uint32_t node) const;
  std::span<const TriangleLeaf> leaves() const;

 private:
  friend DopTree tree_of_shape(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options,
                               TreeShape&& shape);
  DopTree(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options, TreeShape&& shape);

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  DopTreeOptions options_;
  std::vector<NodeHead> heads_;
  std::vector<SlabLine> slabs_;
  std::unique_ptr<DopVertices> vertices_;  // of trees realigned by brute force only
  std::vector<TriangleLeaf> leaves_;
  std::size_t lines_of_node_ = 0;
  std::uint64_t id_ = 0;
  std::int64_t degenerate_triangles_ = 0;
  int depth_ = 0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_size_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double inverse_radius_ = 0.0;
};

}  // namespace glissade::collision
