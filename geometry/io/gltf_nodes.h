#pragma once

/// The nodes of a glTF document: which belong to the scene, and where they are in it.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "io/gltf_document.h"

namespace glissade::geometry {

class GltfNodes {
 public:
  /// Rejects a node that has two parents. `document` must outlive this.
  explicit GltfNodes(GltfDocument& document);

  /// The nodes of the default scene, parents before their children: of scene `scene` or else the first one. A document
  /// without scenes has one of all its nodes.
  std::vector<std::size_t> of_scene() const;

  /// X_SceneNode, also of a node that is in no scene.
  const Eigen::Affine3d& pose(std::size_t node);

 private:
  /// The roots of the scene. Warns of other scenes.
  std::vector<std::size_t> roots() const;

  GltfDocument& document_;
  std::vector<std::optional<std::size_t>> parents_;
  std::vector<std::optional<Eigen::Affine3d>> poses_;  // those computed so far
};

}  // namespace glissade::geometry
