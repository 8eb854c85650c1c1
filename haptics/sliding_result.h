#pragma once

/// The answer of a simulation of sliding contact, whatever its method: poses, state and contacts.

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::haptics {

/// The two features in contact: the part's first, the obstacle's second.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
  kOverlap,  ///< the part overlapped the obstacle at its start and is on its way out
};

std::string_view name_of(ContactKind kind);

/// A place where a part and an obstacle are close.
///
/// Obstacle, kind and the two features identify a contact: these numbers stay the same as long as the same features are
/// close. The triangles follow from the features, because each edge and vertex has one triangle that answers for it.
struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  std::int32_t obstacle;  ///< number of the body: obstacles first, in their order, then the parts in theirs
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit normal, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< the contact point on the part, metres
  double gap;           ///< metres; negative only for kOverlap
  double force = 0.0;   ///< newtons along n_W; 0 while the contact does not push
  /// The feature on either side: the triangle of a face, the number of an edge in `geometry::MeshTopology`, or the
  /// number of a vertex in the mesh; −1 where the method does not report it.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;                                 ///< number among the parts
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, across n_W
  double margin = 0.0;                                   ///< metres at which the contact holds both sides apart

  /// The contact point on the obstacle, metres.
  Eigen::Vector3d q_W() const { return p_W - gap * n_W; }
};

/// The state of a part at the end of a call.
enum class SlidingState : std::uint8_t {
  kReleased,    ///< no hand holds the part; it stands still
  kFree,        ///< the visible part is at its target
  kSliding,     ///< contacts push, the part moves along them
  kResting,     ///< contacts push, the part stands still
  kCatchingUp,  ///< nothing pushes, but the part is not at its target yet
};

std::string_view name_of(SlidingState state);

/// The outcome of one call of `advance` for one part.
struct SlidingResult {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< the ghost
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the target: where the metaphor wants the part
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle and the pose at which they were found; those with a force push. With several parts,
  /// contacts are carried along with the last step of both sides, and the pose is X_WV.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  double reach = 0.0;  ///< metres from that pose within which all contacts are known
  int pushing = 0;     ///< number of contacts with a force
  int cycles = 0;      ///< projection cycles, or bisections, of the call
};

}  // namespace glissade::haptics
