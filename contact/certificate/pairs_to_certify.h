#pragma once

/// Two items that a step must keep apart: boxes, or triangles where boxes are too coarse.

#include <cstdint>

#include <Eigen/Core>

#include <glissade/collision/dop_tree.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// A node, a leaf or a triangle of a body's tree.
struct TreeItem {
  enum class Kind : std::uint8_t { kNode, kLeaf, kTriangle };

  Kind kind;
  std::uint32_t number;
  const collision::Obb* box;  ///< box of its triangles; null for a triangle
};

/// A child of a node as an item; the node must have it.
TreeItem child_of(const ContactBody& body, std::uint32_t node, int child);

/// Two items that a step must keep apart.
struct PairToCertify {
  BodyPair bodies;
  TreeItem item_O;
  TreeItem item_V;
  double distance;      ///< metres: their separation along n_W at the poses of the search
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part; zero where triangles touched
};

}  // namespace glissade::contact
