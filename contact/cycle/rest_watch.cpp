#include "cycle/rest_watch.h"

namespace glissade::contact {
namespace {

constexpr double kTargetStands_m = 10e-6;
constexpr double kPartStays_m = 0.1e-3;
constexpr double kUntilRestless_ms = 200.0;

}  // namespace

void RestWatch::observe(const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref,
                        double lever, bool moved, double milliseconds) {
  const auto between = [&](const Eigen::Isometry3d& X_from, const Eigen::Isometry3d& X_to) {
    return geometry::motion_bound(geometry::displacement_between(X_from, X_to, p_Vref), lever);
  };
  // Where a restless part finds its way to a better place, it might come back from there if it were not restless any
  // more.
  const bool gets_somewhere = !is_restless_ && between(X_WV_, X_WV) > kPartStays_m;
  if (between(X_WT_, X_WT) > kTargetStands_m || gets_somewhere) {
    X_WV_ = X_WV;
    X_WT_ = X_WT;
    here_ms_ = 0.0;
    stays_ = false;
    is_restless_ = false;
    return;
  }
  here_ms_ += milliseconds;
  stays_ = here_ms_ > kUntilRestless_ms;
  is_restless_ = is_restless_ || (moved && stays_);
}

}  // namespace glissade::contact
