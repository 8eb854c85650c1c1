#pragma once

/// What steps have to be proved free of: pairs of boxes of the bodies' trees, and of triangles
/// where boxes do not tell enough, that hold all pairs of triangles which are near.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include "certificate/obb_tree.h"
#include "scene/contact_scene.h"

namespace glissade::haptics {

/// A node of a body's tree, a leaf of it, or a triangle.
struct TreeItem {
  enum class Kind : std::uint8_t { kNode, kLeaf, kTriangle };

  Kind kind;
  std::uint32_t number;
  const Obb* box;  ///< of what it holds; none of a triangle
};

/// A child of a node, which must have it.
TreeItem child_of(const ContactBody& body, std::uint32_t node, int child);

/// Two items that a step must keep apart.
struct PairToCertify {
  BodyPair bodies;
  TreeItem item_O;
  TreeItem item_V;
  double distance;      ///< metres that n_W keeps them apart where the bodies were placed
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part; zero where triangles touched
};

/// Replaces `to_certify` by all that is within `radius` (metres) of the bodies where they are placed here, but of
/// those that are `ignored`; the nearest first. The bodies are those of the scene, which are asked for margins
/// only.
void find_pairs_to_certify(const ContactScene& scene, std::span<const PlacedBody> bodies, double radius,
                           std::span<const BodyPair> ignored, collision::QueryWorkspace& workspace,
                           std::vector<PairToCertify>& to_certify);

}  // namespace glissade::haptics
