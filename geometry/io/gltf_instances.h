#pragma once

/// Instances of glTF (EXT_mesh_gpu_instancing): copies of the mesh of a node.

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "io/gltf_accessors.h"
#include "io/gltf_document.h"

namespace glissade::geometry {

/// X_NodeMesh of each copy of the mesh of a node. A node without the extension has one copy, at its origin.
std::vector<Eigen::Affine3d> instances(const GltfDocument& document, GltfAccessors& accessors, std::size_t node);

}  // namespace glissade::geometry
