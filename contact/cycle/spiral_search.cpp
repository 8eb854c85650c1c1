#include "cycle/spiral_search.h"

#include <cmath>
#include <numbers>

namespace glissade::contact {
namespace {

constexpr double kLeastLag_m = 0.1e-3;
constexpr double kStill_m = 0.5e-6;  // in a call
constexpr double kPatience_ms = 100.0;
constexpr double kLongestSearch_ms = 2000.0;
constexpr double kElsewhere_m = 1e-3;  // so much a hand may go on pressing

constexpr double kOffset_m = 1.6e-3;
constexpr double kTilt = 1.4 * std::numbers::pi / 180.0;
constexpr double kTurns_per_ms = 0.01;

}  // namespace

void SpiralSearch::observe(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref,
                           const geometry::Displacement& error, double moved, bool is_held, double milliseconds) {
  const bool is_stuck = is_held && geometry::motion_bound(error, radius_) > kLeastLag_m;
  if (has_begun_ && is_elsewhere(X_WT, p_Vref)) {
    is_searching_ = has_begun_ = false;
    still_ms_ = 0.0;
  }
  if (is_searching_) {
    searched_ms_ += milliseconds;
    is_searching_ = is_stuck && searched_ms_ < kLongestSearch_ms;
    return;
  }
  still_ms_ = is_stuck && moved < kStill_m ? still_ms_ + milliseconds : 0.0;
  if (has_begun_ || still_ms_ < kPatience_ms) return;
  is_searching_ = has_begun_ = true;
  searched_ms_ = 0.0;
  stuck_ = error;
  X_WT_ = X_WT;
}

bool SpiralSearch::is_elsewhere(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const {
  return geometry::motion_bound(geometry::displacement_between(X_WT_, X_WT, p_Vref), radius_) > kElsewhere_m;
}

Eigen::Isometry3d SpiralSearch::aim(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const {
  if (!is_searching_) return X_WT;
  const Eigen::Vector3d axis = stuck_.v.norm() > 0.0 ? stuck_.v.normalized() : stuck_.w.normalized();
  const Eigen::Vector3d first = axis.unitOrthogonal();
  const double angle = 2.0 * std::numbers::pi * kTurns_per_ms * searched_ms_;
  const Eigen::Vector3d beside = std::cos(angle) * first + std::sin(angle) * axis.cross(first);
  // Tilted so that the end ahead of the reference point goes the same way, and farther: that end is stuck.
  const double growth = searched_ms_ / kLongestSearch_ms;
  return geometry::displaced(X_WT, p_Vref, {growth * kOffset_m * beside, growth * kTilt * axis.cross(beside)});
}

}  // namespace glissade::contact
