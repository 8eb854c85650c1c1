#pragma once

/// The DOP-tree: a hierarchy of discretely oriented polytopes over a triangle soup (paper §2.1).
/// Build one per mesh, share it between objects and threads, and query pairs of them with `dop_query.h`.

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <glissade/collision/dop.h>
#include <glissade/collision/triangle_mesh.h>

namespace glissade::collision {

/// One node: its polytope, and either two children or a run of triangles.
struct DopNode {
  Dop dop;
  std::int32_t first =
      0;  ///< inner node: its first child, the second follows; leaf: the first entry of `leaf_triangles()`
  std::int32_t count = 0;  ///< 0 for an inner node, otherwise the leaf's number of triangles

  bool is_leaf() const { return count > 0; }
};

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
};

/// An immutable bounding-volume hierarchy in the object's own frame.
///
/// Thread-safety: immutable after construction, so any number of threads may query it at once.
class DopTree {
 public:
  /// Builds the hierarchy by binned surface-area heuristic; deterministic. Degenerate triangles (zero area) are left
  /// out of the tree and counted.
  ///
  /// Throws std::invalid_argument when the mesh has no triangle of positive area, an index out of range, or a
  /// coordinate that is not finite or beyond ±1e9. Cost O(n log n). Queries are fastest when
  /// the mesh lies near its own origin.
  explicit DopTree(std::shared_ptr<const TriangleMesh> mesh, const DopTreeOptions& options = {});

  const DopTreeOptions& options() const { return options_; }

  const TriangleMesh& mesh() const { return *mesh_; }

  /// Node 0 is the root.
  const std::vector<DopNode>& nodes() const { return nodes_; }
  /// Triangle indices of the mesh in leaf order.
  const std::vector<std::int32_t>& leaf_triangles() const { return leaf_triangles_; }

  std::int64_t degenerate_triangles() const { return degenerate_triangles_; }
  /// Levels below the root; a tree of one leaf has depth 0.
  int depth() const { return depth_; }
  /// Largest absolute coordinate of the mesh in metres; the rounding bounds of the queries scale with it.
  double largest_coordinate() const { return largest_coordinate_; }
  /// Centre and radius in metres of a sphere about the bounding box that holds every vertex of the tree.
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  std::size_t memory_bytes() const;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  DopTreeOptions options_;
  std::vector<DopNode> nodes_;
  std::vector<std::int32_t> leaf_triangles_;
  std::int64_t degenerate_triangles_ = 0;
  int depth_ = 0;
  double largest_coordinate_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
};

}  // namespace glissade::collision
