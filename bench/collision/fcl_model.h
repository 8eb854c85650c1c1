#pragma once

/// The FCL model of all comparisons: a tree of OBBs with rectangle swept spheres, FCL's best for rigid meshes.

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::bench {

using FclTree = fcl::BVHModel<fcl::OBBRSS<double>>;

inline FclTree fcl_tree(const geometry::TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  FclTree tree;
  tree.beginModel(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.vertices.size()));
  tree.addSubModel(mesh.vertices, triangles);
  tree.endModel();
  return tree;
}

}  // namespace glissade::bench
