#pragma once

/// A place where part and obstacles are close, as the projection sees it.

#include <cstdint>
#include <string_view>

#include <Eigen/Geometry>

namespace glissade::haptics {

/// The two features that are close: the part's first, the obstacle's second.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
  kOverlap,  ///< the part is being led out of an obstacle that overlapped it at its start
};

std::string_view name_of(ContactKind kind);

/// A contact is known by obstacle, kind and the two features: they are the same numbers as long as the same features
/// are close, and the triangles follow from them, as each edge and vertex has one triangle that answers for it.
struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  std::int32_t obstacle;  ///< number among the bodies of the surroundings; it may be another part
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< the contact point on the part, metres
  double gap;           ///< metres; negative only for kOverlap
  double force = 0.0;   ///< newtons along n_W; 0 where the contact does not push
  /// The feature of either side: of a face its triangle, of an edge its number in `collision::MeshTopology`, of a
  /// vertex its number in the mesh; −1 where none is told.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;                                 ///< number among the parts that are held
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across n_W

  /// The contact point on the obstacle, metres.
  Eigen::Vector3d q_W() const { return p_W - gap * n_W; }
};

/// The contact after its two sides have moved by X_W and, where that moves too, X_W_obstacle (in the world), to first
/// order: the normal stays; a vertex of the part stays where it is on the part, else the obstacle's point does on it.
Contact carried(const Contact& contact, const Eigen::Isometry3d& X_W,
                const Eigen::Isometry3d& X_W_obstacle = Eigen::Isometry3d::Identity());

/// A contact of two parts as the other one sees it: `body_of_part` is the number among the bodies of the part that the
/// contact was told for, `other_part` the number among the parts of the other.
Contact mirrored(const Contact& contact, std::int32_t body_of_part, std::int32_t other_part);

}  // namespace glissade::haptics
