#pragma once

/// The user's choices in a simulation of sliding contact: metaphor, stiffness, friction, margins, and the rules for
/// parts that are stuck or that start inside an obstacle.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/metaphor.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::contact {

class SlidingPart;

/// Coefficients of Coulomb friction. If both coefficients are 0, contacts push along their normals only.
struct Friction {
  double at_rest = 0.0;  ///< while the two bodies do not slip: friction is at most at_rest × the normal force
  double sliding = 0.0;  ///< while the two bodies slip; not greater than at_rest

  bool is_on() const { return at_rest > 0.0 || sliding > 0.0; }
  bool operator==(const Friction&) const = default;
};

/// The largest allowed margin (metres). The margin is the gap at which contacts stop a part. The margin must be small
/// compared to the radius of a contact search.
inline constexpr double kGreatestMargin_m = 0.25e-3;

/// Minimum clearance as a fraction of the margin. A part takes a step only if the path is certified: a numerical proof
/// shows that the part keeps the minimum clearance from every other body on the whole path. A path that starts nearer
/// to a body keeps 95 % of the distance at the start.
inline constexpr double kMinClearanceOfMargin = 0.3;

/// Maximum number of parts in one simulation.
inline constexpr std::size_t kMaxParts = 4;

/// The treatment of a part that overlaps an obstacle by more than the margin at the start. Two parts must not overlap
/// by more than the margin at the start. Smaller overlaps are always allowed. A part in such an overlap moves wherever
/// it gets no deeper into the other body than a twentieth of the margin (more at some corners: docs/sliding.md). It
/// comes apart from the other body as soon as there is room.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< the constructor of the simulation (`Sliding`, `MultiPartSliding`) throws
  /// Regardless of the hand, the part leaves the obstacle without turning, at kSlew_m (`spring.h`) per millisecond, on
  /// a short straight path that leads no deeper into any body. Other obstacles stop the part as usual. If the part
  /// overlaps several obstacles, it leaves the deepest overlap first. If there is no such path, or if the path is
  /// blocked for twenty calls, the part follows the hand as far as the overlap gets no deeper. Once apart, part and
  /// obstacle are an ordinary pair. The constructor still throws for a scripted part (`HeldPart::script`), for a closed
  /// part that no inset (`inset_mesh`) frees, and for an open part that is free on no side within two margins.
  kDepenetrate,
};

/// Rules for all parts of a simulation.
struct SlidingRules {
  /// Maximum number of cycles in one call of `Sliding::advance`, at least 1. Each cycle projects the wanted
  /// displacement on the displacements that contacts allow, and takes one step. With more cycles, the part follows
  /// corners more closely. With fewer cycles, a call takes less time.
  int max_cycles = 10;
  /// The margin: the gap (metres) at which contacts stop a part. Default: 1e-4 of the part's radius, but at least 2 µm
  /// and at most 10 µm. Obstacles may have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Starts a spiral search when contacts keep a part from its target, as a hand searches for a hole with a peg. The
  /// part then aims at tilted poses on a growing spiral about the target, up to 1.6 mm beside the target and tilted by
  /// up to 1.4°. A search lasts two seconds at most.
  bool spiral_search = false;
  /// Searches for near triangles ahead of need in a separate thread, so that few calls wait for a search. Set this for
  /// simulations in real time. Poses and forces are the same to the bit with and without the thread.
  bool has_search_thread = false;
  /// A call also finds the contacts that the ghost may meet in this time (milliseconds), at the ghost's speed in the
  /// last call. A haptic thread then knows these contacts while it waits for the next contact set. The distance is
  /// limited to 3 mm, or less where searches find very many pairs of triangles. Finite and not negative.
  double contacts_ahead_ms = 0.0;
  /// Number of pairs that a search may find. If a search finds more pairs, the radius of the next searches is halved,
  /// down to 0.2 mm, and steps are shorter. Answers then come sooner, and a fast part falls behind. At least 1. A
  /// search that finds more than two million pairs of triangles and boxes is repeated with a much smaller radius. At
  /// the smallest radius, it is repeated with twice the limit of pairs.
  std::size_t affordable_pairs = 30'000;
  /// Work of the searches of one call, and also of the cycles of one call. If searches use more than half of the budget
  /// on average, the reach becomes shorter. The unit is about a nanosecond of an ordinary processor. But the work
  /// counts pairs and proofs, so no bit of a result depends on the machine's speed or instruction set. A call ends when
  /// the work is used up, or one indivisible piece later: a projection on the contacts, or the proof of a pair of boxes
  /// or leaves. At least 2; std::nullopt: no limit. With a limit but without `has_search_thread`, searches have a
  /// thread that works only while the simulation waits.
  std::optional<std::int64_t> work_budget{};

  bool operator==(const SlidingRules&) const = default;
};

/// The rules for a simulation behind a `HapticServer`: few cycles, a search thread, short searches, and contacts ahead
/// for the time that a contact set is in use. A budget of work keeps the age of the answers independent of the meshes.
constexpr SlidingRules real_time_rules() {
  SlidingRules rules;
  rules.max_cycles = 3;
  rules.has_search_thread = true;
  rules.contacts_ahead_ms = 6.0;
  rules.affordable_pairs = 3000;
  rules.work_budget = 8'000'000;  // docs/benchmarks.md has the ages of answers with and without it
  return rules;
}

/// The poses of the ghost over time, for a part that no hand holds.
struct PartScript {
  geometry::PoseTrajectory X_WB;
  std::chrono::nanoseconds start{0};  ///< script time at which the simulation begins

  Eigen::Isometry3d pose_at(std::chrono::duration<double, std::milli> since_start) const noexcept {
    return X_WB.pose_at(start + std::chrono::round<std::chrono::nanoseconds>(since_start));
  }
};

/// A chain of riders. Riders are bodies without a ghost, such as the segments of a hand. They stand still where the
/// caller places them, or move with the part to which their chain is attached. Riders never stop each other, so hands
/// may penetrate each other.
struct RiderChain {
  std::vector<std::shared_ptr<const SlidingPart>> bodies;
  double margin = 20e-6;  ///< metres: the gap at which contacts of these bodies stop a part
};

/// A part and the hand or script that holds it. To push other parts, a scripted part needs a greater `stiffness` than
/// the other parts. A scripted part waits at obstacles, because it cannot push them.
struct HeldPart {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();  ///< unused for a scripted part
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `stiffness_of_part` of the part's radius
  std::string name = "the part";                 ///< for messages
  /// If set, the script holds the part, and no hand can grasp it. Neither spiral search nor depenetration moves a
  /// scripted part.
  std::optional<PartScript> script{};
};

}  // namespace glissade::contact
