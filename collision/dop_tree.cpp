#include <atomic>
#include <stdexcept>
#include <string>

#include <glissade/collision/dop_tree.h>

#include "dop_tree_build.h"
#include "dop_tree_fit.h"

namespace glissade::collision {
namespace {

constexpr double kLargestCoordinate = 1e9;
constexpr std::size_t kMostTriangles = 5'000'000;

void check_vertices(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!(mesh.vertices[i].array().abs() <= kLargestCoordinate).all()) {
      throw std::invalid_argument("vertex " + std::to_string(i) +
                                  " has a coordinate that is not finite or beyond ±1e9");
    }
  }
}

void check_triangles(const TriangleMesh& mesh) {
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

TreeShape checked_shape(const TriangleMesh& mesh) {
  check_triangles(mesh);
  check_vertices(mesh);
  return mesh.triangles.empty() ? TreeShape{} : build_shape(mesh);
}

}  // namespace

DopTree::DopTree(const std::shared_ptr<const TriangleMesh>& mesh, const DopTreeOptions& options)
    : DopTree(mesh, options, checked_shape(*mesh)) {}

DopTree::DopTree(std::shared_ptr<const TriangleMesh> mesh, const DopTreeOptions& options, TreeShape&& shape)
    : mesh_(std::move(mesh)),
      options_(options),
      heads_(std::move(shape.nodes)),
      leaves_(std::move(shape.leaves)),
      lines_of_node_(static_cast<std::size_t>(slab_lines(dop_directions(options.directions).slabs))),
      depth_(shape.depth) {
  slabs_.resize(heads_.size() * lines_of_node_);
  if (!heads_.empty()) {
    if (options_.realignment == Realignment::kBruteForce) vertices_ = DopVertices(options_.directions, heads_.size());
    refit();
  }
  if (degenerate_triangles_ == static_cast<std::int64_t>(mesh_->triangles.size())) {
    throw std::invalid_argument("the mesh has no triangle of positive area");
  }
}

DopTree tree_of_shape(std::shared_ptr<const TriangleMesh> mesh, const DopTreeOptions& options, TreeShape&& shape) {
  check_triangles(*mesh);
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
  fit_nodes(options_, leaves_, heads_, slabs_);
  if (options_.realignment == Realignment::kBruteForce) vertices_.fit(heads_, slabs_);
  static std::atomic<std::uint64_t> ids{0};
  id_ = ++ids;
}

std::size_t DopTree::memory_bytes() const {
  return sizeof(*this) + heads_.capacity() * sizeof(NodeHead) + slabs_.capacity() * sizeof(SlabLine) +
         leaves_.capacity() * sizeof(TriangleLeaf) + vertices_.memory_bytes();
}

}  // namespace glissade::collision
