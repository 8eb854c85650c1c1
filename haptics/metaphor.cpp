#include <algorithm>

#include <glissade/haptics/metaphor.h>
#include <glissade/haptics/motion.h>

namespace glissade::haptics {

std::optional<Metaphor> metaphor_from_name(std::string_view name) {
  const auto* const found = std::find(kMetaphorNames.begin(), kMetaphorNames.end(), name);
  if (found == kMetaphorNames.end()) return std::nullopt;
  return static_cast<Metaphor>(found - kMetaphorNames.begin());
}

Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_then,
                              const Eigen::Isometry3d& X_WG_now, const Eigen::Vector3d& p_Vref) {
  switch (metaphor) {
    case Metaphor::kForceFeedback:
    case Metaphor::kRubberBandSpring:
      break;
    case Metaphor::kRubberBand: {
      Eigen::Isometry3d X_WT = X_WV;
      X_WT.translation() = X_WG_now * p_Vref - X_WV.linear() * p_Vref;
      return X_WT;
    }
    case Metaphor::kIncremental:
      return displaced(X_WV, p_Vref, displacement_between(X_WG_then, X_WG_now, p_Vref));
  }
  return X_WG_now;
}

}  // namespace glissade::haptics
