#pragma once

/// The user's choices in a simulation of sliding contact: how hand and part are tied, friction, margins, and the rules
/// for parts that are stuck or that start inside an obstacle.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

struct SlidingPart;

/// The connection between hand and part (paper §3). The ghost is the pose of the part as the hand commands it, without
/// contacts.
enum class Metaphor : std::uint8_t {
  kForceFeedback,     ///< rigid grasp: the device holds the hand back, and the part follows at a limited speed
  kRubberBand,        ///< a rubber band ties the part's reference point to the ghost; only contacts turn the part
  kRubberBandSpring,  ///< a rubber band and a spiral spring tie the part to the ghost; the part catches up at once
  kIncremental,       ///< the part repeats each motion of the ghost from its own pose; refused motion is lost
};

/// Names of the metaphors, as on the command line, in the order of the values of `Metaphor`.
inline constexpr std::array<std::string_view, 4> kMetaphorNames{"force-feedback", "rubber-band", "rubber-band-spring",
                                                                "incremental"};

inline std::string_view name_of(Metaphor metaphor) {
  return kMetaphorNames[static_cast<std::size_t>(metaphor)];
}

/// The metaphor with this name; nothing for an unknown name.
std::optional<Metaphor> metaphor_from_name(std::string_view name);

/// Coefficients of Coulomb friction. If both are 0, contacts push along their normals only.
struct Friction {
  double at_rest = 0.0;  ///< while the two sides do not slip: friction is at most at_rest × the normal force
  double sliding = 0.0;  ///< while the two sides slip; not greater than at_rest

  bool is_on() const { return at_rest > 0.0 || sliding > 0.0; }
};

/// The largest allowed margin (metres), so that margins stay small beside the radius of a contact search.
inline constexpr double kGreatestMargin_m = 0.25e-3;

/// Minimum clearance as a fraction of the margin. Every certified path keeps the minimum clearance from every other
/// body.
inline constexpr double kMinClearanceOfMargin = 0.3;

/// Maximum number of parts in one simulation.
inline constexpr std::size_t kMaxParts = 4;

/// The treatment of a part that overlaps an obstacle at its start. Two parts must never overlap at their start.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< the constructor throws
  /// The part moves out of the obstacle on a short straight way without turning, at kSlew_m (`coupling.h`) per
  /// millisecond, regardless of the hand. Once part and obstacle are one margin apart, the part follows the hand again,
  /// and the obstacle is like any other. Other obstacles hold the part on its way out, so the part stops at an obstacle
  /// that is in its way. If a part overlaps several obstacles, it moves out of the deepest overlap first.
  kDepenetrate,
};

/// Rules for all parts of a simulation.
struct SlidingRules {
  /// Maximum number of projection cycles in one call, at least 1. With more cycles the part follows corners more
  /// closely; with fewer cycles a call takes less time.
  int max_cycles = 10;
  /// The margin: the distance (metres) at which contacts hold a part away. Default: 1e-4 of the part's radius, but at
  /// least 2 µm and at most 10 µm. Obstacles may have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Starts a spiral search when contacts hold a part away from its target: the part then aims at a growing spiral
  /// around the target, as a hand searches for a hole with a peg. The spiral grows to 1.6 mm and 1.4° from the target.
  /// A search lasts two seconds at most.
  bool spiral_search = false;
  /// Searches for near triangles ahead of need in a thread of its own, so that few calls wait for a search. Use this
  /// for simulations in real time. Poses and forces are the same to the bit with and without the thread.
  bool has_search_thread = false;
};

/// One of the parts and its holder, a hand or a script. A script moves its part without a hand. The grip of a script is
/// stiffer than the grips on the parts that the scripted part pushes. A scripted part waits at obstacles, which it
/// cannot push out of its way.
struct HeldPart {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `default_stiffness` of the part's radius
  std::string name = "the part";                 ///< for messages
  /// Whether a script holds the part. A scripted part follows its script or waits; neither spiral search nor
  /// depenetration moves it.
  bool is_scripted = false;
};

}  // namespace glissade::haptics
