#include "sliding/wanted_pose.h"

#include <glissade/geometry/displacement.h>

namespace glissade::haptics {

Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_previous,
                              const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref) {
  switch (metaphor) {
    case Metaphor::kForceFeedback:
    case Metaphor::kRubberBandSpring:
      break;
    case Metaphor::kRubberBand: {
      Eigen::Isometry3d X_WT = X_WV;
      X_WT.translation() = X_WG * p_Vref - X_WV.linear() * p_Vref;
      return X_WT;
    }
    case Metaphor::kIncremental:
      return geometry::displaced(X_WV, p_Vref, geometry::displacement_between(X_WG_previous, X_WG, p_Vref));
  }
  return X_WG;
}

}  // namespace glissade::haptics
