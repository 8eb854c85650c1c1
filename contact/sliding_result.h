#pragma once

/// The result of a simulation of sliding contact: poses, state and contacts.
///
/// A part is an object that a hand moves. For a part, every fixed body and every other part is an obstacle. The ghost
/// is the pose that the part would have if nothing were in the way. The target is the pose towards which the part
/// moves. The metaphor is the rule by which the hand moves the part. The metaphor determines the target from the ghost.
/// The visible part follows the target as far as the contacts allow.

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/spring.h>

namespace glissade::contact {

/// The kinds of the two features (vertex, edge or face) in contact. The feature of the part comes first.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
  kOverlap,  ///< the part overlapped the obstacle at the start and is leaving it
};

GLISSADE_EXPORT std::string_view name_of(ContactKind kind);

/// A place where a part and an obstacle are close.
///
/// A contact is identified by part, rider, obstacle, kind and the two features while these features are close. The
/// features determine the triangles, because one triangle owns each edge and each vertex (see
/// `geometry::MeshTopology`).
struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  /// Number of the other body. The fixed obstacles come first, then the parts, then the riders, each in the order given
  /// to the simulation's constructor.
  std::int32_t obstacle;
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit normal, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< contact point on the part (kOverlap: the part's reference point), metres
  double gap;           ///< metres; negative only for kOverlap
  double force = 0.0;   ///< newtons on the part, along n_W; 0 if the contact does not push
  /// Numbers of the two features. A face has the number of its triangle. An edge has its number in
  /// `geometry::MeshTopology`. A vertex has its number in the mesh. −1 means that the features are unknown. They are
  /// unknown for overlaps, for contacts of triangle pairs whose certificate failed, and for contacts that the paper's
  /// method cannot classify.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;  ///< number of the part
  /// Number of the rider (see `RiderChain`) in contact, counted over all chains; −1 for a contact of the part itself.
  std::int32_t rider = -1;
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, perpendicular to n_W
  /// The gap (metres) at which the contact stops the part. This is the margin of the two bodies, or less if there is
  /// not enough room. With the paper's method, `margin` is the largest gap of a reported contact: 2 µm, i.e. 4 times
  /// the final width of a bisection. With the paper's method, contacts stop the part at half the final width.
  double margin = 0.0;
  /// The contact is valid until the part has moved by this distance (metres) across n_W. After a longer motion, the
  /// contact point may have left one of the two features. `range` is infinite if no rim of the two features is near.
  /// An edge between coplanar triangles is not a rim.
  double range = std::numeric_limits<double>::infinity();
  /// Speed (m/s) of the other body's contact point along n_W in the last call; 0 for fixed obstacles.
  double approach = 0.0;

  /// The contact point on the obstacle, metres.
  Eigen::Vector3d q_W() const { return p_W - gap * n_W; }
};

/// The state of a part at the end of a call.
enum class SlidingState : std::uint8_t {
  kReleased,    ///< no hand holds the part, and the part stands still
  kFree,        ///< the visible part is at its target
  kSliding,     ///< contacts push, and the part moves along them
  kResting,     ///< contacts push, and the part stands still
  kCatchingUp,  ///< no contact pushes, but the part is not at its target yet
};

GLISSADE_EXPORT std::string_view name_of(SlidingState state);
/// The outcome of one call of `advance` for one part.
struct SlidingResult {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< the ghost
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the target
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part
  /// The visible part before the last step. From this pose, a caller can reconstruct the path of the last step, but not
  /// of earlier steps. The paper's method does not set this pose.
  Eigen::Isometry3d X_WV_before_step = Eigen::Isometry3d::Identity();
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle, for the part at X_WV_of_contacts. A contact pushes if its force is positive. With
  /// the paper's method or several parts, X_WV_of_contacts is X_WV. With several parts, contacts found before the last
  /// step have been moved along with the parts. With one part, X_WV_of_contacts is X_WV_before_step in the following
  /// three cases, and X_WV in all other cases:
  /// - The last step was short.
  /// - No contact pushed.
  /// - The work budget of the call was used up.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  /// `contacts` has every contact whose gap is smaller than `reach` (metres), with the part at X_WV_of_contacts. The
  /// paper's method finds only the contacts at which its bisections ended. With that method, `reach` is the largest gap
  /// that can be reported.
  double reach = 0.0;
  int pushing = 0;  ///< number of contacts with a positive force
  /// The call ended because its work budget was used up. With a larger budget, the part would have moved farther.
  bool ended_early = false;
  int cycles = 0;  ///< number of cycles; with the paper's method: number of bisections
};

/// The wrench of a part's contacts on the hands that hold the part, about the reference point p_Vref, in world axes. At
/// rest, this wrench balances the coupling spring. The wrench is zero while the part only catches up.
GLISSADE_EXPORT Wrench contact_wrench(const SlidingResult& result, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::contact
