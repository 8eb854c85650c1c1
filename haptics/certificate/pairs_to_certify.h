#pragma once

/// Pairs a step must be certified against: box pairs, refined to triangle pairs where boxes are too coarse. Together
/// they cover every triangle pair within the search radius.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include "certificate/obb_tree.h"
#include "scene/contact_scene.h"

namespace glissade::haptics {

/// A node, a leaf or a triangle of a body's tree.
struct TreeItem {
  enum class Kind : std::uint8_t { kNode, kLeaf, kTriangle };

  Kind kind;
  std::uint32_t number;
  const Obb* box;  ///< box of its triangles; null for a triangle
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

/// Replaces `to_certify` by the pairs within `radius` (metres) of each other at the poses of `bodies`, except
/// pairs of `ignored` bodies, which are in ascending order. `bodies` has the bodies of the scene in their order; the
/// scene itself supplies margins only.
void find_pairs_to_certify(const ContactScene& scene, std::span<const PlacedBody> bodies, double radius,
                           std::span<const BodyPair> ignored, collision::QueryWorkspace& workspace,
                           std::vector<PairToCertify>& to_certify);

}  // namespace glissade::haptics
