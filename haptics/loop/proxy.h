#pragma once

/// The proxy: where the part would be *now*, according to the newest contact set, which may be some milliseconds old.
/// It gives the haptic thread a force that follows the hand at its own rate, without any collision query.

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_set.h>

#include "solver/projection.h"

namespace glissade::haptics {

/// Real-time safe: bounded work, no allocation. Not thread-safe.
class Proxy {
 public:
  /// For a part with the given reference point (in its frame), radius (metres) and coupling, at its start pose.
  Proxy(const Eigen::Vector3d& p_Vref, double radius, const CouplingStiffness& stiffness,
        const Eigen::Isometry3d& X_WV_start)
      : p_Vref_(p_Vref),
        radius_(radius),
        stiffness_(stiffness),
        solver_(kMaxContactRows),
        X_WG_(X_WV_start),
        X_WP_(X_WV_start) {}

  /// The proxy for ghost X_WG: the ghost itself, bit for bit, where no contact of the set is in its way; otherwise the
  /// ghost projected on the set's contacts. Follows a change of contacts at no more than kSlew_m plus twice the ghost's
  /// own motion a call, so that the force cannot jump.
  const Eigen::Isometry3d& update(const ContactSet& set, const Eigen::Isometry3d& X_WG) noexcept;

  const Eigen::Isometry3d& pose() const noexcept { return X_WP_; }

 private:
  Eigen::Isometry3d target(const ContactSet& set, const Eigen::Isometry3d& X_WG) noexcept;

  Eigen::Vector3d p_Vref_;
  double radius_;
  CouplingStiffness stiffness_;
  ProjectionSolver solver_;
  Eigen::Isometry3d X_WG_;
  Eigen::Isometry3d X_WP_;
};

}  // namespace glissade::haptics
