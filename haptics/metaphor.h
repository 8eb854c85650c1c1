#pragma once

/// How hand and part are tied (paper §3): where a metaphor wants the part, given the ghost.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <Eigen/Geometry>

namespace glissade::haptics {

enum class Metaphor : std::uint8_t {
  kForceFeedback,     ///< rigid grasp; the device holds the hand back, and the part catches up at a limited speed
  kRubberBand,        ///< the part hangs on the ghost by its reference point; contacts alone turn it
  kRubberBandSpring,  ///< the part is tied to the ghost by a rubber band and a spiral spring and catches up at once
  kIncremental,       ///< the part repeats each motion of the ghost from where it is; what contacts refuse is forgotten
};

/// In the order of their numbers, as on the command line.
inline constexpr std::array<std::string_view, 4> kMetaphorNames{"force-feedback", "rubber-band", "rubber-band-spring",
                                                                "incremental"};

inline std::string_view name_of(Metaphor metaphor) {
  return kMetaphorNames[static_cast<std::size_t>(metaphor)];
}

/// None for any other name.
std::optional<Metaphor> metaphor_from_name(std::string_view name);

/// Where the part is wanted that is at X_WV, when the ghost has gone from X_WG_then to X_WG_now; `p_Vref` is the
/// reference point in the part's frame. Two of the metaphors want the ghost's own pose, bit for bit. The rubber band
/// wants its reference point and the rotation of X_WV. Incremental motion wants X_WV moved as the ghost was: its
/// reference point as far, and turned by as much.
Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_then,
                              const Eigen::Isometry3d& X_WG_now, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::haptics
