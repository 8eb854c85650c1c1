#pragma once

/// Skins of glTF: joints, which are nodes, place the points of a mesh, each by its weights (linear blend skinning).

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "io/gltf_accessors.h"
#include "io/gltf_document.h"
#include "io/gltf_meshes.h"
#include "io/gltf_nodes.h"

namespace glissade::geometry {

/// The skins of a document, which must outlive this, as must the others.
class GltfSkins {
 public:
  GltfSkins(GltfDocument& document, GltfAccessors& accessors, GltfNodes& nodes)
      : document_(document), accessors_(accessors), nodes_(nodes) {}

  /// X_SceneMesh at each point of a primitive that has the skin `number`: the mean, by the weights of the point, of
  /// where its joints place the mesh. The node of the mesh does not matter. That of a point of no triangle is the
  /// identity. Warns of weights that do not add up to 1.
  std::vector<Eigen::AffineCompact3d> placements(const nlohmann::json& number, const GltfPrimitive& primitive);

 private:
  struct Skin {
    std::string where;
    std::vector<std::size_t> joints;                            // nodes
    std::vector<double> inverse_bind;                           // 16 numbers for each joint; empty where all are 1
    std::vector<std::optional<Eigen::Affine3d>> X_SceneMeshes;  // for each joint, those computed so far
  };
  struct Sets;
  struct Influence;

  Skin& skin(const nlohmann::json& number);
  Sets sets(const GltfPrimitive& primitive);
  const Eigen::Affine3d& by_joint(Skin& skin, std::size_t joint);
  Eigen::AffineCompact3d blended(Skin& skin, std::vector<Influence>& influences, const std::string& where);

  GltfDocument& document_;
  GltfAccessors& accessors_;
  GltfNodes& nodes_;
  std::map<std::size_t, Skin> skins_;
};

}  // namespace glissade::geometry
