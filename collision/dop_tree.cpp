#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include <glissade/base/assert.h>
#include <glissade/collision/dop_tree.h>

#include "tree/dop.h"
#include "tree/dop_node.h"
#include "tree/dop_tree_build.h"
#include "tree/dop_tree_fit.h"
#include "tree/dop_vertices.h"

namespace glissade::collision {

/// The OBB tree of a DOP-tree, made when it is first asked for. Thread-safe.
class KnownObbTree {
 public:
  KnownObbTree() = default;
  KnownObbTree(const KnownObbTree& other) : known_(other.known()) {}
  KnownObbTree& operator=(const KnownObbTree&) = delete;
  ~KnownObbTree() = default;

  std::shared_ptr<const ObbTree> of(const DopTree& tree) {
    const std::scoped_lock lock(mutex_);
    if (known_ == nullptr) known_ = std::make_shared<const ObbTree>(tree);
    return known_;
  }

  void forget() {
    const std::scoped_lock lock(mutex_);
    known_ = nullptr;
  }

 private:
  std::shared_ptr<const ObbTree> known() const {
    const std::scoped_lock lock(mutex_);
    return known_;
  }

  mutable std::mutex mutex_{};
  std::shared_ptr<const ObbTree> known_{};
};

namespace {

constexpr double kLargestCoordinate = 1e9;
constexpr std::size_t kMostTriangles = 5'000'000;

void check_vertices(const geometry::TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!(mesh.vertices[i].array().abs() <= kLargestCoordinate).all()) {
      throw std::invalid_argument("vertex " + std::to_string(i) +
                                  " has a coordinate that is not finite or beyond ±1e9");
    }
  }
}

void check_triangles(const geometry::TriangleMesh& mesh) {
  if (mesh.triangles.size() > kMostTriangles) {
    throw std::invalid_argument("the mesh has " + std::to_string(mesh.triangles.size()) + " triangles, more than " +
                                std::to_string(kMostTriangles));
  }
  const auto vertex_count = static_cast<std::int64_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::int32_t index : mesh.triangles[i]) {
      if (index < 0 || index >= vertex_count) {
        throw std::invalid_argument("triangle " + std::to_string(i) + " names vertex " + std::to_string(index) +
                                    " of " + std::to_string(vertex_count));
      }
    }
  }
}

const geometry::TriangleMesh& required(const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  if (mesh == nullptr) throw std::invalid_argument("a DOP-tree needs a mesh");
  return *mesh;
}

TreeShape checked_shape(const geometry::TriangleMesh& mesh) {
  check_triangles(mesh);
  check_vertices(mesh);
  return mesh.triangles.empty() ? TreeShape{} : build_shape(mesh);
}

}  // namespace

DopTree::DopTree(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const DopTreeOptions& options)
    : DopTree(mesh, options, checked_shape(required(mesh))) {}

DopTree::DopTree(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options, TreeShape&& shape)
    : mesh_(std::move(mesh)),
      options_(options),
      heads_(std::move(shape.nodes)),
      leaves_(std::move(shape.leaves)),
      obbs_(std::make_unique<KnownObbTree>()),
      lines_of_node_(static_cast<std::size_t>(slab_lines(dop_directions(options.directions).slabs))),
      depth_(shape.depth) {
  slabs_.resize(heads_.size() * lines_of_node_);
  if (!heads_.empty()) {
    if (options_.realignment == Realignment::kBruteForce) {
      vertices_ = std::make_unique<DopVertices>(options_.directions, heads_.size());
    }
    refit();
  }
  if (degenerate_triangles_ == static_cast<std::int64_t>(mesh_->triangles.size())) {
    throw std::invalid_argument("the mesh has no triangle of positive area");
  }
}

DopTree::DopTree(const DopTree& other)
    : mesh_(other.mesh_),
      options_(other.options_),
      heads_(other.heads_),
      slabs_(other.slabs_),
      vertices_(other.vertices_ == nullptr ? nullptr : std::make_unique<DopVertices>(*other.vertices_)),
      leaves_(other.leaves_),
      obbs_(std::make_unique<KnownObbTree>(*other.obbs_)),
      lines_of_node_(other.lines_of_node_),
      id_(other.id_),
      degenerate_triangles_(other.degenerate_triangles_),
      depth_(other.depth_),
      center_(other.center_),
      half_size_(other.half_size_),
      radius_(other.radius_),
      inverse_radius_(other.inverse_radius_) {}

DopTree& DopTree::operator=(const DopTree& other) {
  if (this != &other) *this = DopTree(other);
  return *this;
}

DopTree::DopTree(DopTree&&) noexcept = default;
DopTree& DopTree::operator=(DopTree&&) noexcept = default;
DopTree::~DopTree() = default;

std::size_t DopTree::node_count() const {
  return heads_.size();
}

std::size_t DopTree::leaf_count() const {
  return leaves_.size();
}

TreeNode DopTree::node(std::uint32_t number) const {
  GLISSADE_ASSERT(number < heads_.size());
  const NodeHead& head = heads_[number];
  return {head.first_node, head.first_leaf, head.node_count, head.leaf_count};
}

std::span<const std::int32_t, DopTree::kWidth> DopTree::triangles_of_leaf(std::uint32_t leaf) const {
  GLISSADE_ASSERT(leaf < leaves_.size());
  return leaves_[leaf].triangle;
}

DopTree tree_of_shape(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options,
                      TreeShape&& shape) {
  check_triangles(required(mesh));
  return {std::move(mesh), options, std::move(shape)};
}

void DopTree::refit() {
  check_vertices(*mesh_);
  const TreeGrid grid = grid_of(*mesh_);
  center_ = grid.center;
  half_size_ = grid.half_size;
  radius_ = grid.radius;
  inverse_radius_ = 1.0 / grid.radius;
  degenerate_triangles_ = fit_leaves(*mesh_, grid, leaves_);
  fit_nodes(options_.directions, options_.thin_slab, leaves_, heads_, slabs_);
  if (vertices_) vertices_->fit(heads_, slabs_);
  obbs_->forget();
  static std::atomic<std::uint64_t> ids{0};
  id_ = ++ids;
}

std::shared_ptr<const ObbTree> DopTree::obb_tree() const {
  return obbs_->of(*this);
}

std::size_t DopTree::memory_bytes() const {
  return sizeof(*this) + heads_.capacity() * sizeof(NodeHead) + slabs_.capacity() * sizeof(SlabLine) +
         leaves_.capacity() * sizeof(TriangleLeaf) + (vertices_ ? vertices_->memory_bytes() : 0);
}

}  // namespace glissade::collision
