#pragma once

/// Shaking a part that is stuck: where contacts hold it although it is wanted elsewhere, its target goes round in a
/// growing spiral, as a hand does that looks for a hole with a peg.

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

namespace glissade::haptics {

/// The shaker of one part. It cannot tell a part that is stuck from one that is simply pressed against something, so it
/// gives up after two seconds, until the part is wanted elsewhere. Deterministic. Not thread-safe.
class SpiralSearch {
 public:
  /// For a part of the given radius (metres).
  explicit SpiralSearch(double radius) : radius_(radius) {}

  /// What became of a call of `advance` that took so many milliseconds: from where the part is to where it is wanted,
  /// how far it moved (metres), and whether it was held.
  void observe(const geometry::Displacement& error, double moved, bool is_held, double milliseconds);

  bool is_searching() const { return is_searching_; }

  /// Where to aim instead of X_WT: there, but while it shakes beside it and askew, by up to 1.6 mm and 1.4° after two
  /// seconds, going round ten times a second across the direction in which the part was wanted when it got stuck.
  Eigen::Isometry3d aim(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const;

 private:
  double radius_;
  bool is_searching_ = false;
  bool has_given_up_ = false;
  double still_ms_ = 0.0;
  double searched_ms_ = 0.0;
  geometry::Displacement stuck_;  // what was wanted when it got stuck
};

}  // namespace glissade::haptics
