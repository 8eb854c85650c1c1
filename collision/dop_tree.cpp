#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/triangle_intersection.h>

#include "dop_tree_build.h"

namespace glissade::collision {
namespace {

constexpr double kLargestCoordinate = 1e9;

void check_vertices(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!(mesh.vertices[i].cwiseAbs().maxCoeff() <= kLargestCoordinate)) {
      throw std::invalid_argument("vertex " + std::to_string(i) +
                                  " has a coordinate that is not finite or beyond ±1e9");
    }
  }
}

void check_indices(const TriangleMesh& mesh) {
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

}  // namespace

DopTree::DopTree(std::shared_ptr<const TriangleMesh> mesh, const DopTreeOptions& options)
    : mesh_(std::move(mesh)), options_(options) {
  check_vertices(*mesh_);
  check_indices(*mesh_);

  Eigen::AlignedBox3d bounds;
  const auto triangle_count = static_cast<std::int32_t>(mesh_->triangles.size());
  for (std::int32_t t = 0; t < triangle_count; ++t) {
    const TrianglePoints points{mesh_->corner(t, 0), mesh_->corner(t, 1), mesh_->corner(t, 2)};
    if (is_degenerate(points)) {
      ++degenerate_triangles_;
      continue;
    }
    leaf_triangles_.push_back(t);
    for (const Eigen::Vector3d& point : points)
      bounds.extend(point);
  }
  if (leaf_triangles_.empty()) throw std::invalid_argument("the mesh has no triangle of positive area");

  center_ = bounds.center();
  radius_ = 0.0;
  for (const std::int32_t t : leaf_triangles_) {
    for (int c = 0; c < 3; ++c)
      radius_ = std::max(radius_, (mesh_->corner(t, c) - center_).norm());
  }
  largest_coordinate_ = std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
  depth_ = build_nodes(*mesh_, leaf_triangles_, nodes_);
}

std::size_t DopTree::memory_bytes() const {
  return sizeof(*this) + nodes_.capacity() * sizeof(DopNode) + leaf_triangles_.capacity() * sizeof(std::int32_t);
}

}  // namespace glissade::collision
