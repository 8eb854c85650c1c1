#pragma once

/// The options of a simulation of sliding contact. They include metaphors (the ways to couple the hand to the part,
/// paper §3), stiffness, friction and margins, and the rules for parts that are stuck or that start inside an obstacle.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::contact {

class SlidingPart;

/// The connection between hand and part, as in §3 of the paper (docs/notation.md). The ghost is the pose that the hand
/// commands, regardless of contacts.
enum class Metaphor : std::uint8_t {
  kForceFeedback,     ///< rigid grasp; the device pushes the hand back, and the speed of the part is limited
  kRubberBand,        ///< a rubber band ties the part's reference point to the ghost; only contacts turn the part
  kRubberBandSpring,  ///< a rubber band and a spiral spring tie the part to the ghost; the part has no speed limit
  kIncremental,       ///< the part repeats each motion of the ghost; motion that contacts prevent is lost
};

/// The effect of a metaphor on the part.
struct MetaphorTraits {
  std::string_view name;      ///< the name on the command line
  bool limits_speed = false;  ///< the lag changes in 1 ms by at most kSlew_m (`spring.h`) plus the ghost's motion
  bool turns_part = true;     ///< the ghost turns the part; if false, only contacts turn it
  bool makes_up = true;       ///< the part makes up for prevented motion as soon as contacts allow it
};

/// The traits of all metaphors, indexed by `Metaphor`.
inline constexpr std::array<MetaphorTraits, 4> kMetaphors{{{.name = "force-feedback", .limits_speed = true},
                                                           {.name = "rubber-band", .turns_part = false},
                                                           {.name = "rubber-band-spring"},
                                                           {.name = "incremental", .makes_up = false}}};

constexpr const MetaphorTraits& traits_of(Metaphor metaphor) {
  return kMetaphors[static_cast<std::size_t>(metaphor)];
}

inline constexpr std::array<std::string_view, kMetaphors.size()> kMetaphorNames = [] {
  std::array<std::string_view, kMetaphors.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = kMetaphors[i].name;
  return names;
}();

inline std::string_view name_of(Metaphor metaphor) {
  return traits_of(metaphor).name;
}

/// The metaphor with this name; std::nullopt for an unknown name.
GLISSADE_EXPORT std::optional<Metaphor> metaphor_from_name(std::string_view name);

/// The target X_WT of a part at X_WV, after the ghost has moved from X_WG_previous to X_WG. `p_Vref` is the reference
/// point in the part's frame. The target depends on the `MetaphorTraits`:
/// - Without `makes_up`, the target is X_WV, displaced by the translation of the ghost's reference point and by the
///   ghost's rotation.
/// - Without `turns_part`, the target has the ghost's reference point and the rotation of X_WV.
/// - Otherwise the target is equal to X_WG, bit for bit.
GLISSADE_EXPORT Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV,
                                              const Eigen::Isometry3d& X_WG_previous, const Eigen::Isometry3d& X_WG,
                                              const Eigen::Vector3d& p_Vref);

/// Coefficients of Coulomb friction. If both coefficients are 0, contacts push along their normals only.
struct Friction {
  double at_rest = 0.0;  ///< coefficient without slip: friction is at most at_rest × the normal force
  double sliding = 0.0;  ///< coefficient while the two bodies slip; at most at_rest

  bool is_on() const { return at_rest > 0.0 || sliding > 0.0; }
  bool operator==(const Friction&) const = default;
};

/// The largest allowed margin (metres). The margin is the gap at which contacts stop a part. The margin must be small
/// compared to the radius of a contact search.
inline constexpr double kGreatestMargin_m = 0.25e-3;

/// Minimum clearance as a fraction of the margin. A part takes a step only if the path of the step is certified. The
/// certificate proves that the part keeps the minimum clearance from every other body on the whole path. A path that
/// starts nearer to a body keeps 95 % of its initial distance.
inline constexpr double kMinClearanceOfMargin = 0.3;

/// Maximum number of parts in one simulation.
inline constexpr std::size_t kMaxParts = 4;

/// The treatment of a part that overlaps an obstacle by more than the margin at the start. Two parts must not overlap
/// by more than the margin at the start. Smaller overlaps are always allowed. In a smaller overlap, the part gets
/// deeper into the other body by at most a twentieth of the margin (more at some corners, see docs/sliding.md). The
/// part leaves the other body as soon as there is room.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< the constructor of the simulation (`Sliding`, `MultiPartSliding`) throws
  /// The part leaves the obstacle without turning, at kSlew_m (`spring.h`) per millisecond, whatever the hand does. The
  /// path is short and straight, and leads no deeper into any body. Other obstacles stop the part as usual. If the part
  /// overlaps several obstacles, it leaves the deepest overlap first. If there is no such path, or if the path is
  /// blocked for twenty calls, the part follows the hand as far as the overlap does not become deeper. Once part and
  /// obstacle are apart, they are an ordinary pair. The constructor still throws for:
  /// - a scripted part (see `HeldPart::script`)
  /// - a closed part that no inset (see `inset_mesh`) frees
  /// - an open part that is free on no side within two margins
  kDepenetrate,
};

/// Rules for all parts of a simulation.
struct SlidingRules {
  /// Maximum number of cycles in one call of `Sliding::advance`, at least 1. Each cycle projects the wanted
  /// displacement on the displacements that contacts allow, and takes one step. With more cycles, the part follows
  /// corners more closely. Fewer cycles take less time.
  int max_cycles = 10;
  /// The margin: the gap (metres) at which contacts stop a part. Default: 1e-4 of the part's radius, but at least 2 µm
  /// and at most 10 µm. Obstacles may have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Starts a spiral search when contacts keep a part from its target. A hand with a peg searches for a hole in the
  /// same way. In a spiral search, the part moves towards poses on a growing spiral about the target. These poses are
  /// up to 1.6 mm beside the target, and tilted by up to 1.4°. A search lasts two seconds at most.
  bool spiral_search = false;
  /// A separate thread searches for near triangles in advance, so that few calls wait for a search. Set this to true
  /// for simulations in real time. Poses and forces are bit-identical with and without the thread.
  bool has_search_thread = false;
  /// A call also finds the contacts that the ghost may reach within this time (milliseconds) at the speed of the last
  /// call. A haptic thread then knows these contacts while it waits for the next contact set. The distance is limited
  /// to 3 mm, or less where searches find very many pairs of triangles. Finite and not negative.
  double contacts_ahead_ms = 0.0;
  /// Number of pairs that a search may find, at least 1. If a search finds more pairs, the limit of the reach is halved
  /// (but not below 0.2 mm), and steps become shorter. Calls then take less time, but a fast part lags behind its
  /// target. A search that finds more than two million pairs of triangles and boxes is repeated with a much smaller
  /// radius. If the radius is already the smallest, the limit of two million is doubled instead.
  std::size_t affordable_pairs = 30'000;
  /// Maximum work of the searches in one call. The cycles of one call may use the same amount in addition. If searches
  /// use more than half of the budget on average, the reach becomes shorter. The unit is about a nanosecond of an
  /// ordinary processor. Work is counted in pairs and proofs, so no bit of a result depends on the machine's speed or
  /// instruction set. A call ends when the budget is used up, or one indivisible piece of work later. Such a piece is a
  /// projection on the contacts, or the proof for a pair of boxes or leaves. At least 2; std::nullopt means no limit.
  /// If there is a limit and `has_search_thread` is false, searches run in a thread that works only while the
  /// simulation waits.
  std::optional<std::int64_t> work_budget{};

  bool operator==(const SlidingRules&) const = default;
};

/// The rules for a simulation that a `HapticServer` runs: few cycles, a search thread and short searches.
/// `contacts_ahead_ms` covers the time for which a contact set is in use. The work budget makes the age of the answers
/// independent of the meshes.
constexpr SlidingRules real_time_rules() {
  SlidingRules rules;
  rules.max_cycles = 3;
  rules.has_search_thread = true;
  rules.contacts_ahead_ms = 6.0;
  rules.affordable_pairs = 3000;
  rules.work_budget = 8'000'000;  // for the ages of answers with and without a budget, see docs/benchmarks.md
  return rules;
}

/// A script: the poses of the ghost over time, for a part that no hand holds.
struct PartScript {
  geometry::PoseTrajectory X_WB;
  std::chrono::nanoseconds start{0};  ///< script time at which the simulation begins

  Eigen::Isometry3d pose_at(std::chrono::duration<double, std::milli> since_start) const noexcept {
    return X_WB.pose_at(start + std::chrono::round<std::chrono::nanoseconds>(since_start));
  }
};

/// A chain of riders. Riders are bodies without a ghost, such as the segments of a hand. Riders stand still where the
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
