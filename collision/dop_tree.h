#pragma once

/// The DOP-tree: a bounding-volume hierarchy of discretely oriented polytopes over a triangle soup (paper §2.1). Build
/// one tree for each mesh. Objects and threads may share a tree. The queries of `dop_query.h` take two trees. In all
/// names and comments, "node" means an inner node of a tree. Leaves are not nodes. A file can keep a tree for later
/// runs.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::collision {

class KnownObbTree;
class ObbTree;
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
/// tree are numbered separately. Those of the children that are nodes have consecutive numbers, as have the leaves.
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
class GLISSADE_EXPORT DopTree {
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
  /// reject. The tree is then unchanged.
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

  /// The oriented boxes of the tree as it is fitted now. The first call makes them, later calls and copies of the tree
  /// share them. Thread-safe.
  std::shared_ptr<const ObbTree> obb_tree() const;

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
  std::unique_ptr<KnownObbTree> obbs_;
  std::size_t lines_of_node_ = 0;  // cache lines of slabs for each node, after its head
  std::uint64_t id_ = 0;
  std::int64_t degenerate_triangles_ = 0;
  int depth_ = 0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_size_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double inverse_radius_ = 0.0;
};

/// An oriented bounding box: all points x with |axes.col(i)·(x − c)| ≤ half_size[i] and |x − c| ≤ radius; metres. The
/// axes are orthonormal, the first is the direction of least thickness: the box of a plane patch is as flat as rounding
/// allows, however large the patch is. A negative radius marks an empty box.
struct Obb {
  Eigen::Vector3d c;
  Eigen::Matrix3d axes;
  Eigen::Vector3d half_size;
  double radius;

  /// Half of the extent of the box along a unit vector n, metres.
  double extent_along(const Eigen::Vector3d& n) const { return half_size.dot((axes.transpose() * n).cwiseAbs()); }
};

/// An OBB tree (Gottschalk, Lin and Manocha 1996) with the nodes of a DOP-tree: a box for every child of every node, in
/// the frame of the tree. The slabs of a DOP-tree lie on a 16-bit grid, which suffices to find near triangles. These
/// boxes are for proofs at micrometres. Immutable, so threads may share it.
class GLISSADE_EXPORT ObbTree {
 public:
  /// Cost O(n log n).
  explicit ObbTree(const DopTree& tree);

  /// The box of the triangles below a child, which the node must have.
  const Obb& box(std::uint32_t node, int child) const {
    return boxes_[static_cast<std::size_t>(DopTree::kWidth) * node + static_cast<std::size_t>(child)];
  }

 private:
  std::vector<Obb> boxes_;
};

// Cache files. A cache file next to a mesh file saves the building of the tree in every run: with 100,000 triangles,
// building takes 102 ms of processor time, and reading takes 31 ms.
//
// A file holds only the shape of a tree, i.e. which triangles share a leaf, and which leaves and nodes share a parent.
// `read_tree_cache` checks that the shape is one tree of all triangles, and fits the bounding volumes to the given
// mesh. So a damaged or forged file is either rejected or gives a tree with correct answers. The file takes 4.4 bytes
// a triangle.
//
// A file is valid only for the same vertices and triangles, the same options, and the same version of the format. The
// version of the format also changes when the algorithm that builds trees changes. The byte order is the same on every
// machine. The last eight bytes are a checksum of all other bytes. The checksum detects every change of a single byte,
// and all but one in 2^64 of the other changes.

/// How a cache file was read.
enum class CacheState {
  kRead,
  kMissing,  ///< the file does not exist
  kStale,    ///< the file belongs to another mesh, other options or another version
  kDamaged,  ///< the file is truncated, altered, unreadable, or not a cache file
};

/// Result of reading a file.
struct CachedTree {
  CacheState state;
  std::string reason;           ///< why the file was not read, in a few words
  std::optional<DopTree> tree;  ///< empty if the file was not read

  explicit operator bool() const { return tree.has_value(); }
};

/// The cache file of a mesh file: the name of the mesh file followed by ".dop-tree".
GLISSADE_EXPORT std::filesystem::path tree_cache_path(const std::filesystem::path& mesh_path);

/// Writes or replaces the file. The file has another name until it is complete. A file that cannot be completed is
/// deleted. So `path` never names an incomplete file. Replaces regular files only, and not, for example, symbolic
/// links. Throws std::runtime_error with one line that names the file and the reason. May block on the disk.
GLISSADE_EXPORT void write_tree_cache(const std::filesystem::path& path, const DopTree& tree);

/// Reads the tree that DopTree(mesh, options) would build. An unusable file is not an error, see `CachedTree::state`.
/// Throws for the same meshes and options as the constructor of DopTree. Cost O(n log n). May block on the disk.
GLISSADE_EXPORT CachedTree read_tree_cache(const std::filesystem::path& path,
                                           std::shared_ptr<const geometry::TriangleMesh> mesh,
                                           const DopTreeOptions& options = {});

/// Like `read_tree_cache`, but takes the bytes of a file instead of its path.
GLISSADE_EXPORT CachedTree read_tree_cache_bytes(std::span<const std::byte> bytes,
                                                 std::shared_ptr<const geometry::TriangleMesh> mesh,
                                                 const DopTreeOptions& options = {});

/// A tree, and a note about its cache file.
struct LoadedTree {
  DopTree tree;
  std::string note;  ///< one line that names the file; empty if the file was read, or was missing and is now written
};

/// Reads the tree from the cache file of `mesh_path`. If that file is missing or unusable, builds the tree and writes
/// the file. The note reports a file that is unusable or cannot be written. Throws what the constructor of DopTree
/// throws.
GLISSADE_EXPORT LoadedTree load_or_build_tree(const std::filesystem::path& mesh_path,
                                              const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                                              const DopTreeOptions& options = {});

}  // namespace glissade::collision
