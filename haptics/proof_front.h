#pragma once

/// What steps have to be proved free of: pairs of boxes of the bodies' trees, and of triangles
/// where boxes do not tell enough, that hold all pairs of triangles which are near.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/haptics/surroundings.h>
#include <glissade/haptics/tight_boxes.h>

namespace glissade::haptics {

/// A node of a body's tree, a leaf of it, or a triangle.
struct TreeItem {
  enum class Kind : std::uint8_t { kNode, kLeaf, kTriangle };

  Kind kind;
  std::uint32_t number;
  const TightBox* box;  ///< of what it holds; none of a triangle
};

/// A child of a node, which must have it.
TreeItem child_of(const ContactBody& body, std::uint32_t node, int child);

/// Two items that a step must keep apart.
struct Obligation {
  BodyPair bodies;
  TreeItem item_O;
  TreeItem item_P;
  double distance;      ///< metres that n_W keeps them apart where the bodies were placed
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part; zero where triangles touched
};

/// Replaces `obligations` by all that is within `radius` (metres) of the bodies where they are placed here, but of
/// those that are `ignored`; the nearest first. The bodies are those of the surroundings, which are asked for margins
/// only.
void find_obligations(const Surroundings& surroundings, std::span<const PlacedBody> bodies, double radius,
                      std::span<const BodyPair> ignored, collision::QueryWorkspace& workspace,
                      std::vector<Obligation>& obligations);

}  // namespace glissade::haptics
