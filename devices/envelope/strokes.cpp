#include "envelope/strokes.h"

#include <algorithm>
#include <cmath>

#include "envelope/envelope_settings.h"

namespace glissade::devices {
namespace {

/// What of the vector is longer than `play`.
Eigen::Vector3d beyond(double play, const Eigen::Vector3d& vector) noexcept {
  const double length = vector.norm();
  return length > play ? Eigen::Vector3d((1.0 - play / length) * vector) : Eigen::Vector3d(0.0, 0.0, 0.0);
}

}  // namespace

PoseInPlay::PoseInPlay(double resolution, double max_force) noexcept
    : play_(kEnvelope.play_per_resolution * (resolution > 0.0 ? resolution : kEnvelope.usual_resolution_m)) {
  if (max_force > 0.0) play_ = std::min(play_, 0.5 * kEnvelope.most_stirred_J / max_force);
}

geometry::Displacement PoseInPlay::follow(const Eigen::Isometry3d& X_WH) noexcept {
  const Eigen::Vector3d root = Eigen::Vector3d::Zero();
  const geometry::Displacement whole = geometry::displacement_between(X_WH_, X_WH, root);
  const geometry::Displacement step{beyond(play_, whole.v), beyond(play_ / kEnvelope.lever_m, whole.w)};
  X_WH_ = geometry::displaced(X_WH_, root, step);
  return step;
}

void Strokes::observe(const BookedMotion& motion, const GivenWrenches& given) noexcept {
  if (motion.from.time != last_) pose_.start_at(motion.from.X_WH);
  last_ = motion.to.time;
  const geometry::Displacement step = pose_.follow(motion.to.X_WH);
  const double work = given.work(
      motion.begin, motion.end, [&](double u) { return Eigen::Vector3d(u * step.v); },
      [&](double u) { return Eigen::Vector3d(u * step.w); });
  // No more than that counts, so that a contact is calm soon after a great stroke.
  double& stirred = work < 0.0 ? came_ : went_;
  stirred = std::min(stirred + std::abs(work), kEnvelope.most_stirred_J);
}

void Strokes::forget(double dt) noexcept {
  const double kept = 1.0 - std::min(1.0, dt / kEnvelope.forget_s);
  came_ *= kept;
  went_ *= kept;
}

double Strokes::calm() const noexcept {
  // A force that comes back and slowly moves the hand is no oscillation.
  return std::max(0.0, 1.0 - 2.0 * std::min(came_, went_) / kEnvelope.most_stirred_J);
}

}  // namespace glissade::devices
