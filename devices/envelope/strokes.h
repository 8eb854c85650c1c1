#pragma once

/// Whether a hand rests in its contact or moves to and fro.

#include <chrono>
#include <optional>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "envelope/given_wrenches.h"
#include "envelope/state_check.h"

namespace glissade::devices {

/// A pose that follows the measured one with a play, so that noise of the tracker is no motion.
class PoseInPlay {
 public:
  /// `resolution` (m) of the measured position; 0: not known. The play is four times this, but so short that the
  /// largest force gives no more than 5 mJ on this way: a greater stroke cannot hide.
  PoseInPlay(double resolution, double max_force) noexcept;

  void start_at(const Eigen::Isometry3d& X_WH) noexcept { X_WH_ = X_WH; }
  /// Returns the displacement of the hand root by which it follows.
  geometry::Displacement follow(const Eigen::Isometry3d& X_WH) noexcept;

 private:
  double play_;  // m
  Eigen::Isometry3d X_WH_ = Eigen::Isometry3d::Identity();
};

/// The work that came from the hand and went to it, in about the last half second.
class Strokes {
 public:
  Strokes(double resolution, double max_force) noexcept : pose_(resolution, max_force) {}

  void observe(const BookedMotion& motion, const GivenWrenches& given) noexcept;

  void forget(double dt) noexcept;

  /// 1: nothing goes to and fro. 0: 5 mJ or more do.
  double calm() const noexcept;

 private:
  PoseInPlay pose_;
  std::optional<std::chrono::nanoseconds> last_;  // measurement of the glove up to which it was observed
  double came_ = 0.0;                             // J
  double went_ = 0.0;
};

}  // namespace glissade::devices
