#pragma once

/// Morph targets of glTF: displacements of a mesh's points, each with a weight.

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "io/gltf_accessors.h"
#include "io/gltf_document.h"
#include "io/gltf_meshes.h"

namespace glissade::geometry {

/// The weights of the morph targets of mesh `mesh` at a node that has it: those of the node, or else those of the mesh.
std::vector<double> morph_weights(const GltfDocument& document, std::size_t node, std::size_t mesh);

/// The positions of a primitive, displaced by its targets with these weights.
std::vector<Eigen::Vector3d> morphed_positions(GltfDocument& document, GltfAccessors& accessors,
                                               const GltfPrimitive& primitive, const std::vector<double>& weights);

}  // namespace glissade::geometry
