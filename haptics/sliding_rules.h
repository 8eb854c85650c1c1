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

/// How hand and part are tied (paper §3).
enum class Metaphor : std::uint8_t {
  kForceFeedback,     ///< rigid grasp; the device holds the hand back, and the part catches up at a limited speed
  kRubberBand,        ///< the part hangs on the ghost by its reference point; contacts alone turn it
  kRubberBandSpring,  ///< a rubber band and a spiral spring tie the part to the ghost; it catches up at once
  kIncremental,       ///< the part repeats each motion of the ghost from where it is; refused motion is forgotten
};

/// In the order of their numbers, as on the command line.
inline constexpr std::array<std::string_view, 4> kMetaphorNames{"force-feedback", "rubber-band", "rubber-band-spring",
                                                                "incremental"};

inline std::string_view name_of(Metaphor metaphor) {
  return kMetaphorNames[static_cast<std::size_t>(metaphor)];
}

/// The metaphor of that name; nothing for an unknown name.
std::optional<Metaphor> metaphor_from_name(std::string_view name);

/// Coefficients of Coulomb friction. With both 0, contacts push along their normals only.
struct Friction {
  double at_rest = 0.0;  ///< while the two sides do not slip: holds up to at_rest × the normal force
  double sliding = 0.0;  ///< while they slip; at most at_rest

  bool is_on() const { return at_rest > 0.0 || sliding > 0.0; }
};

/// The largest margin (metres): margins are small beside the range of one contact search.
inline constexpr double kGreatestMargin_m = 0.25e-3;

/// Minimum clearance as a fraction of the margin: every certified path keeps this far from every other body.
inline constexpr double kMinClearanceOfMargin = 0.3;

/// Parts in one simulation, at most.
inline constexpr std::size_t kMaxParts = 4;

/// The treatment of a part that overlaps an obstacle at its start. Two parts must never overlap at their start.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< the constructor throws
  /// The part moves out by a short way, straight and without turning, by kSlew_m a millisecond, wherever the hand wants
  /// it. Once both are a margin apart, the part follows the hand again, and the obstacle is like any other. Other
  /// obstacles hold the part meanwhile, so it stays where one is in its way. With several overlaps, the deepest comes
  /// first.
  kDepenetrate,
};

/// Rules for all parts of a simulation.
struct SlidingRules {
  /// Projection cycles in one call: more follow corners more closely, fewer bound the work. At least 1.
  int max_cycles = 10;
  /// Metres at which contacts hold a part away. Default: 1e-4 of the part's radius, at least 2 µm and at most 10 µm.
  /// Obstacles may have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Starts a spiral search when contacts hold a part away from its target: the part then aims at a growing spiral
  /// around the target, as a hand looks for a hole with a peg, up to 1.6 mm and 1.4° from it, for two seconds at most.
  bool spiral_search = false;
  /// Searches for near triangles in a thread of its own, ahead of need, so that few calls wait; for simulations in real
  /// time. Poses and forces are the same to the bit.
  bool has_search_thread = false;
};

/// One of the parts and its holder. A script holds a part that moves on its own, with a stiffer grip than the parts it
/// pushes; the part waits for obstacles that it cannot push out of its way.
struct HeldPart {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `default_stiffness` of the part's radius
  std::string name = "the part";                 ///< for messages
  bool is_scripted = false;  ///< goes where its script says or waits; neither spiral search nor depenetration moves it
};

}  // namespace glissade::haptics
