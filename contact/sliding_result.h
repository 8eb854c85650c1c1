#pragma once

/// The result of a simulation of sliding contact: poses, state and contacts.
///
/// A part is an object that a hand moves. An obstacle of a part is a fixed body, or another part. The ghost is the pose
/// that the part would have if nothing were in the way. The target is the pose at which the part aims. The metaphor,
/// i.e. the rule by which the hand moves the part, computes the target from the ghost. The visible part follows the
/// target as far as the contacts allow.

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>

namespace glissade::contact {

/// The kinds of the two features (vertex, edge or face) in contact, the feature of the part first.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
  kOverlap,  ///< the part overlapped the obstacle at the start and is leaving it
};

std::string_view name_of(ContactKind kind);

/// A place where a part and an obstacle are close.
///
/// Part, rider, obstacle, kind and the two features identify a contact while these features are close. The triangles
/// follow from the features, because one triangle owns each edge and each vertex (`geometry::MeshTopology`).
struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  /// Number of the other body. The fixed obstacles come first, then the parts, then the riders, each in the order given
  /// to the simulation's constructor.
  std::int32_t obstacle;
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit normal, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< the contact point on the part, metres; for kOverlap the part's reference point
  double gap;           ///< metres; negative only for kOverlap
  double force = 0.0;   ///< newtons along n_W; 0 if the contact does not push
  /// Numbers of the two features. A face has the number of its triangle. An edge has its number in
  /// `geometry::MeshTopology`, and a vertex its number in the mesh. −1 means that the features are unknown, as for
  /// overlaps, for contacts of triangle pairs whose certificate failed, and for contacts that the paper's method cannot
  /// classify.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;  ///< number of the part among the parts
  /// Number, among all riders, of the rider (`RiderChain`) in contact; −1 for a contact of the part itself.
  std::int32_t rider = -1;
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, perpendicular to n_W
  /// The gap (metres) at which the contact stops the part: the margin of the two bodies, or less where room is lacking.
  /// With the paper's method, `margin` is the largest gap of a reported contact: 2 µm, i.e. 4 times the width at which
  /// a bisection ends. Contacts of the paper's method demand a gap of only half of this width.
  double margin = 0.0;
  /// The contact is valid until the part has moved by this distance (metres) across n_W. After a longer motion, the
  /// contact point may have left one of the two features. Infinite if no rim of the features is near. An edge between
  /// coplanar triangles is no rim.
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
  kSliding,     ///< contacts push, and the part moves along the contacts
  kResting,     ///< contacts push, and the part stands still
  kCatchingUp,  ///< no contact pushes, but the part is not at its target yet
};

std::string_view name_of(SlidingState state);
/// The outcome of one call of `advance` for one part.
struct SlidingResult {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< the ghost
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< the target
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();  ///< the visible part
  /// The visible part before the last step. So a caller can reconstruct only the path of the last step. Not set by the
  /// paper's method.
  Eigen::Isometry3d X_WV_before_step = Eigen::Isometry3d::Identity();
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle, given for the part at X_WV_of_contacts. This pose is X_WV_before_step if the last
  /// step was short, if no contact pushed, or if the work of the call was used up. Otherwise, and always with the
  /// paper's method or several parts, it is X_WV. With several parts, contacts found before the last step have been
  /// moved along with the parts. A contact pushes if its force is positive.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  /// Metres. `contacts` has every contact whose gap is smaller than `reach`, with the part at X_WV_of_contacts. The
  /// paper's method finds only the contacts at which its bisections ended; `reach` is then the largest gap that it can
  /// report.
  double reach = 0.0;
  int pushing = 0;  ///< number of contacts with a force
  /// The call ended because its work was used up. With more work, the part would have moved farther.
  bool ended_early = false;
  int cycles = 0;  ///< number of cycles; with the paper's method: number of bisections
};

/// The wrench of a part's contacts on the hands that hold the part, about the reference point p_Vref, in world axes. At
/// rest this wrench balances the coupling spring. It is zero while the part only catches up.
Wrench contact_wrench(const SlidingResult& result, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::contact
