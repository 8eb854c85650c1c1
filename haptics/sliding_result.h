#pragma once

/// The answer of a simulation of sliding contact, whatever its method: poses, state and contacts.

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::haptics {

/// The two features in contact: first the feature of the part, then the feature of the obstacle.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
  kOverlap,  ///< the part overlapped the obstacle at its start and is moving out of it
};

std::string_view name_of(ContactKind kind);

/// A place where a part and an obstacle are close.
///
/// Obstacle, kind and the two features identify a contact: they stay the same as long as the same features are close.
/// The triangles follow from the features, because one triangle owns each edge and each vertex
/// (`geometry::MeshTopology`).
struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  /// Number of the other body: first the obstacles, then the parts, each in the order given to the constructor.
  std::int32_t obstacle;
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit normal, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< the contact point on the part, metres
  double gap;           ///< metres; negative only for kOverlap
  double force = 0.0;   ///< newtons along n_W; 0 while the contact does not push
  /// The feature of the part and the feature of the obstacle. A face is given by the number of its triangle, an edge by
  /// its number in `geometry::MeshTopology`, a vertex by its number in the mesh. −1 if the method does not report
  /// features.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;                                 ///< number of the part among the parts
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across n_W
  double margin = 0.0;  ///< distance (metres) at which the contact holds both sides apart

  /// The contact point on the obstacle, metres.
  Eigen::Vector3d q_W() const { return p_W - gap * n_W; }
};

/// The state of a part at the end of a call.
enum class SlidingState : std::uint8_t {
  kReleased,    ///< no hand holds the part; it stands still
  kFree,        ///< the visible part is at its target
  kSliding,     ///< contacts push, and the part moves along the contacts
  kResting,     ///< contacts push, and the part stands still
  kCatchingUp,  ///< no contact pushes, but the part is not at its target yet
};

std::string_view name_of(SlidingState state);

/// The outcome of one call of `advance` for one part.
struct SlidingResult {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< the ghost
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the target: the pose that the metaphor wants of the part
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle, and the pose of the part at which they were found. A contact pushes if its force
  /// is positive. With several parts, the contacts are carried along with the last step of both sides; X_WV_of_contacts
  /// is then X_WV.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  /// Metres: at X_WV_of_contacts, all contacts with a smaller gap are known.
  double reach = 0.0;
  int pushing = 0;  ///< number of contacts with a force
  int cycles = 0;   ///< projection cycles in the call; bisections for the paper's method
};

}  // namespace glissade::haptics
