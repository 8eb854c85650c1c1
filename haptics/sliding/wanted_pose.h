#pragma once

/// The target pose of a metaphor (paper §3).

#include <Eigen/Geometry>

#include <glissade/haptics/sliding_rules.h>

namespace glissade::haptics {

/// The target X_WT of a part at X_WV after the ghost has gone from X_WG_previous to X_WG; `p_Vref` is the reference
/// point in the part's frame. Force feedback and the rubber band with a spring want the ghost's pose, bit for bit. The
/// rubber band wants the ghost's reference point and the rotation of X_WV. Incremental motion wants X_WV displaced as
/// the ghost was: the same translation of the reference point, the same rotation.
Eigen::Isometry3d wanted_pose(Metaphor metaphor, const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WG_previous,
                              const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::haptics
