#pragma once

/// Trees that own their meshes.

#include <memory>
#include <utility>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

namespace glissade::test_support {

inline collision::DopTree tree_of(geometry::TriangleMesh mesh, const collision::DopTreeOptions& options = {}) {
  return collision::DopTree(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)), options);
}

/// The tree of a cube of one metre, for tests in which its shape does not matter.
inline std::shared_ptr<const collision::DopTree> cube_tree(const collision::DopTreeOptions& options = {}) {
  return std::make_shared<const collision::DopTree>(tree_of(geometry::make_box({1.0, 1.0, 1.0}, 12), options));
}

}  // namespace glissade::test_support
