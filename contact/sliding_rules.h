#pragma once

/// The user's choices in a simulation of sliding contact: how hand and part are tied, friction, margins, and the rules
/// for parts that are stuck or that start inside an obstacle.

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

/// Coefficients of Coulomb friction. If both are 0, contacts push along their normals only.
struct Friction {
  double at_rest = 0.0;  ///< while the two bodies do not slip: friction is at most at_rest × the normal force
  double sliding = 0.0;  ///< while the two bodies slip; not greater than at_rest

  bool is_on() const { return at_rest > 0.0 || sliding > 0.0; }
  bool operator==(const Friction&) const = default;
};

/// The largest allowed margin (metres). The margin is the gap at which contacts stop a part. It must stay small beside
/// the radius of a contact search.
inline constexpr double kGreatestMargin_m = 0.25e-3;

/// Minimum clearance as a fraction of the margin. A step of a part is taken only if its path is certified: a numerical
/// proof shows that the part keeps the minimum clearance from every other body all the way. A path that starts
/// nearer to a body keeps 95 % of the distance at its start from that body.
inline constexpr double kMinClearanceOfMargin = 0.3;

/// Maximum number of parts in one simulation.
inline constexpr std::size_t kMaxParts = 4;

/// The treatment of a part that overlaps an obstacle at its start by more than its margin. Two parts must never overlap
/// so far at their start. Parts may always touch, and overlap by a margin: a part then goes wherever it gets no deeper
/// in, to a twentieth of the margin (docs/sliding.md: to more at some corners), and is apart as soon as there is room.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< the constructor of the simulation (`Sliding`, `MultiPartSliding`) throws
  /// The part moves out of the obstacle on a short straight way without turning, at kSlew_m (`spring.h`) per
  /// millisecond, regardless of the hand, if there is such a way on which it gets no deeper into anything. Otherwise,
  /// and where it is blocked on this way for twenty calls, it follows the hand as far as it gets no deeper in. Once
  /// part and obstacle are apart, the obstacle is like any other. Other obstacles stop the part as usual. If a part
  /// overlaps several obstacles, it moves out of the deepest overlap first. Where the part is no closed surface, or
  /// would have to be thinner than nothing to be free, and for a scripted part (`HeldPart::script`), the constructor of
  /// the simulation throws all the same.
  kDepenetrate,
};

/// Rules for all parts of a simulation.
struct SlidingRules {
  /// Maximum number of cycles in one call of `Sliding::advance`, at least 1. Each cycle projects the wanted
  /// displacement on the contacts and takes one step. With more cycles the part follows corners more closely; with
  /// fewer cycles a call takes less time.
  int max_cycles = 10;
  /// The margin: the gap (metres) at which contacts stop a part. Default: 1e-4 of the part's radius, but at least 2 µm
  /// and at most 10 µm. Obstacles may have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Starts a spiral search when contacts keep a part from its target, the pose that the metaphor wants for the part.
  /// The part then aims at poses beside the target, on a growing spiral and tilted, as a hand searches for a hole with
  /// a peg. The poses are up to 1.6 mm beside the target and tilted by up to 1.4°. A search lasts two seconds at most.
  bool spiral_search = false;
  /// Searches for near triangles in a thread of its own before the simulation needs them, so that few calls wait for a
  /// search. Use this for simulations in real time. Poses and forces are the same, bit for bit, with and
  /// without the thread.
  bool has_search_thread = false;
  /// Milliseconds for which the contacts that the ghost may meet are found ahead of need, at its speed in the last
  /// call. Up to 3 mm, and less far where searches find very many pairs of triangles. A haptic thread then knows them
  /// while it waits for the next contact set. Finite and not negative.
  double contacts_ahead_ms = 0.0;
  /// Work of a search: where a search finds more pairs of triangles than this, the next ones look half as far, though
  /// not less than 0.2 mm, and steps are shorter. Answers then come sooner, and a fast part falls behind. At least 1.
  /// A search that finds more than two million pairs, of triangles and of boxes, is given up for one that looks much
  /// less far; the smallest one for one that may find twice as many.
  std::size_t affordable_pairs = 30'000;
  /// Work of one call: searches may take so much, and cycles as much again. Where searches take more than half of it
  /// on average, the reach becomes shorter. The unit is about a nanosecond of an ordinary processor, but it counts
  /// pairs and proofs, so no bit depends on the speed of the machine or its instruction set. A call ends when the work
  /// is used up, or one indivisible piece later: a projection on the contacts, or the proof of a pair of boxes or
  /// leaves. At least 2; none: no limit. With a limit, searches have a thread even without `has_search_thread`, which
  /// then works only while the simulation waits.
  std::optional<std::int64_t> work_budget{};

  bool operator==(const SlidingRules&) const = default;
};

/// The rules for a simulation behind a `HapticServer`: few cycles, a search thread, contacts ahead for the time that a
/// contact set is in use, short searches, and a budget of work, so that the age of the answers does not depend on the
/// meshes.
constexpr SlidingRules real_time_rules() {
  SlidingRules rules;
  rules.max_cycles = 3;
  rules.has_search_thread = true;
  rules.contacts_ahead_ms = 6.0;
  rules.affordable_pairs = 3000;
  rules.work_budget = 8'000'000;  // docs/benchmarks.md has the ages of answers with and without it
  return rules;
}

/// The ghost's poses over time, for a part that moves without a hand.
struct PartScript {
  geometry::PoseTrajectory X_WB;
  std::chrono::nanoseconds start{0};  ///< time of the script when the simulation begins

  Eigen::Isometry3d pose_at(std::chrono::duration<double, std::milli> since_start) const noexcept {
    return X_WB.pose_at(start + std::chrono::round<std::chrono::nanoseconds>(since_start));
  }
};

/// Bodies without a ghost of their own, such as the segments of a hand. They stand where the caller places them, like
/// obstacles, or move with a part to which they are attached. Riders, of one chain or of two, never
/// stop each other: hands may come into each other.
struct RiderChain {
  std::vector<std::shared_ptr<const SlidingPart>> bodies;
  double margin = 20e-6;  ///< metres: the gap at which contacts with these bodies stop a part, or they stop with a part
};

/// One of the parts and its holder: a hand, or a script. To push other parts, a scripted part needs a greater
/// `stiffness` than they have. A scripted part waits at obstacles, which it cannot push out of its way.
struct HeldPart {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();  ///< a scripted part starts where its script does
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `stiffness_of_part` of the part's radius
  std::string name = "the part";                 ///< for messages
  /// If set, the script holds the part, and no hand can. A scripted part follows its script or waits at an obstacle;
  /// neither spiral search nor depenetration moves it.
  std::optional<PartScript> script{};
};

}  // namespace glissade::contact
