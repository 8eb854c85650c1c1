#pragma once

/// Metaphors: the ways to couple the hand to the part (paper §3).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <Eigen/Geometry>

namespace glissade::contact {

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
std::optional<Metaphor> metaphor_from_name(std::string_view name);

/// The target X_WT of a part at X_WV, after the ghost has moved from X_WG_previous to X_WG. `p_Vref` is the reference
/// point in the part's frame. The target depends on the `MetaphorTraits`:
/// - Without `makes_up`, the target is X_WV, displaced by the translation of the ghost's reference point and by the
///   ghost's rotation.
/// - Without `turns_part`, the target has the ghost's reference point and the rotation of X_WV.
/// - Otherwise the target is equal to X_WG, bit for bit.
Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_previous,
                              const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::contact
