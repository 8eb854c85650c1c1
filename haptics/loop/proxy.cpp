#include "loop/proxy.h"

#include <algorithm>

namespace glissade::haptics {

const Eigen::Isometry3d& Proxy::update(const ContactSet& set, const Eigen::Isometry3d& X_WG) noexcept {
  const double ghost_motion = geometry::motion_bound(geometry::displacement_between(X_WG_, X_WG, p_Vref_), radius_);
  X_WG_ = X_WG;
  const Eigen::Isometry3d X_WP_new = target(set, X_WG);
  const geometry::Displacement change = geometry::displacement_between(X_WP_, X_WP_new, p_Vref_);
  const double fraction = geometry::fraction_within(change, radius_, kSlew_m + 2.0 * ghost_motion);
  X_WP_ = fraction < 1.0 ? geometry::displaced(X_WP_, p_Vref_, change.scaled(fraction)) : X_WP_new;
  return X_WP_;
}

Eigen::Isometry3d Proxy::target(const ContactSet& set, const Eigen::Isometry3d& X_WG) noexcept {
  if (set.sequence == 0) return X_WG;  // the simulation has not answered yet
  const geometry::Displacement wanted = geometry::displacement_between(set.X_WV_of_rows, X_WG, p_Vref_);
  const Projection projection = solver_.project(wanted, stiffness_, set.rows());
  if (projection.status != ProjectionStatus::kSolved) return X_WP_;
  // No known contact is in the way. Beyond the reach of the set an unknown one may be; but holding the hand back there
  // would make a late simulation feel like drag, and the visible part is safe whatever the proxy does.
  if (projection.active_count == 0) return X_WG;
  const double fraction = geometry::fraction_within(projection.displacement(), radius_, set.reach);
  return geometry::displaced(set.X_WV_of_rows, p_Vref_, projection.displacement().scaled(fraction));
}

}  // namespace glissade::haptics
