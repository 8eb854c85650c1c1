#pragma once

/// What a step has to be proved free of, kept over several steps: pairs of boxes of the bodies' trees, and of triangles
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

/// Two bodies by their numbers in the surroundings; the obstacle may be another part of lower number.
struct BodyPair {
  std::int32_t obstacle;
  std::int32_t part;

  bool operator==(const BodyPair&) const = default;
};

/// Two items that a step must keep apart.
struct Obligation {
  BodyPair bodies;
  TreeItem item_O;
  TreeItem item_P;
  double distance;      ///< metres, a lower bound at the pose of the search
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part, along which they were that far apart
};

/// Not thread-safe.
class ProofFront {
 public:
  /// The surroundings must outlive this object.
  explicit ProofFront(const Surroundings& surroundings) : surroundings_(surroundings) {}

  /// Finds all that is within `radius` (metres) where the parts are placed, but of bodies that are `ignored`.
  void refresh(double radius, std::span<const BodyPair> ignored);

  /// The obligations that were no further apart than `distance`, the nearest first.
  std::span<const Obligation> within(double distance) const;

  std::size_t size() const { return obligations_.size(); }

 private:
  const Surroundings& surroundings_;
  std::vector<Obligation> obligations_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::haptics
