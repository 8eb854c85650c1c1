#pragma once

/// The answer of a simulation of sliding contact, whatever its method: poses, state and contacts.
///
/// A part is an object that a hand moves. An obstacle of a part is a fixed body, or another part. The ghost is the pose
/// that the part would have if nothing were in the way. The metaphor, i.e. the rule by which the hand moves the part,
/// computes the target from the ghost: the pose that the part aims at. The visible part follows the target as far as
/// the contacts allow.

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>

namespace glissade::contact {

/// The two features (vertex, edge or face) in contact: first the feature of the part, then the feature of the obstacle.
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
/// Part, rider, obstacle, kind and the two features identify a contact as long as the same features are close.
/// The triangles follow from the features, because one triangle owns each edge and each vertex
/// (`geometry::MeshTopology`).
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
  /// Numbers of the two features: for a face the number of its triangle, for an edge its number in
  /// `geometry::MeshTopology`, for a vertex its number in the mesh. −1 if the features are not known: for overlaps, for
  /// contacts of triangle pairs whose proof of no collision failed, and for contacts that the paper's method cannot
  /// classify.
  std::int32_t part_feature = -1;
  std::int32_t obstacle_feature = -1;
  std::int32_t part = 0;  ///< number of the part among the parts
  /// Number of the rider (`RiderChain`) whose contact it is, among the riders; −1: it is a contact of the part itself.
  std::int32_t rider = -1;
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< newtons on the part, perpendicular to n_W
  /// Metres: the gap at which the contact stops the part: the margin of the two bodies, or less where there is too
  /// little room for it. For the paper's method, the margin is instead the largest gap
  /// of a reported contact, 2 µm: 4 brackets, where a bracket is the width at which a bisection ends, 0.5 µm. The
  /// contacts of that method demand a gap of only half a bracket.
  double margin = 0.0;
  /// Metres: the motion across n_W after which the contact point may have left one of the two features, so that the
  /// contact no longer says anything. Infinite if no rim of the features is near enough to tell. Along an edge between
  /// triangles in one plane the feature goes on.
  double range = std::numeric_limits<double>::infinity();
  /// m/s: speed of the other body's contact point along n_W in the last call; 0 for fixed obstacles.
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
  /// The same before the last step: the only one whose way a caller can know. Not set by the paper's method.
  Eigen::Isometry3d X_WV_before_step = Eigen::Isometry3d::Identity();
  SlidingState state = SlidingState::kFree;
  /// The contacts of the last cycle, and the pose of the part for which they are given: the visible pose, or the
  /// one before the last step, if that step was short, no contact pushed, or the work of the call was used up.
  /// For the paper's method and with several parts, that pose is always X_WV; with several parts, contacts from before
  /// the last step have been moved along with it. A contact pushes if its force is positive.
  std::vector<Contact> contacts;
  Eigen::Isometry3d X_WV_of_contacts = Eigen::Isometry3d::Identity();
  /// Metres: with the part at X_WV_of_contacts, `contacts` has every contact with a gap smaller than this. The paper's
  /// method finds only the contacts at which its bisections ended, and gives the largest gap that it reports.
  double reach = 0.0;
  int pushing = 0;  ///< number of contacts with a force
  /// The call ended because its work was used up: the part would have gone farther with more.
  bool ended_early = false;
  int cycles = 0;  ///< cycles of one projection and one step each; for the paper's method, bisections
};

/// What the contacts of a part exert on the hands that hold it, about the part's reference point p_Vref, in world axes.
/// At rest it balances the spring of the coupling. A part that only needs time to follow exerts nothing.
Wrench contact_wrench(const SlidingResult& result, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::contact
