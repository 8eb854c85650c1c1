#pragma once

/// The spiral search of a part that is stuck: while contacts hold it away from its target, its aim goes round the
/// target in a growing spiral, as a hand looks for a hole with a peg.

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

namespace glissade::haptics {

/// The spiral search of one part. It cannot distinguish a part that is stuck from one that is simply pressed against
/// something, so it gives up after two seconds, until the target moves elsewhere. Deterministic. Not thread-safe.
class SpiralSearch {
 public:
  /// For a part of the given radius (metres).
  explicit SpiralSearch(double radius) : radius_(radius) {}

  /// Notes the outcome of a call of `advance` over `milliseconds`: the displacement `error` from the part to its
  /// target, the metres that the part `moved`, and whether contacts held it.
  void observe(const geometry::Displacement& error, double moved, bool is_held, double milliseconds);

  bool is_searching() const { return is_searching_; }

  /// The pose to aim at: X_WT, or during a search a pose beside it and tilted, by up to 1.6 mm and 1.4° after two
  /// seconds. The aim goes round ten times a second, across the direction of the target at the moment the part got
  /// stuck.
  Eigen::Isometry3d aim(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const;

 private:
  double radius_;
  bool is_searching_ = false;
  bool has_given_up_ = false;
  double still_ms_ = 0.0;
  double searched_ms_ = 0.0;
  geometry::Displacement stuck_;  // the error when the part got stuck, or when the search gave up
};

}  // namespace glissade::haptics
