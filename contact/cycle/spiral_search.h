#pragma once

/// The spiral search of a part that is stuck: while contacts hold it away from its target, its aim goes round the
/// target in a growing spiral, as a hand looks for a hole with a peg.

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

namespace glissade::contact {

/// The spiral search of one part. It cannot distinguish a part that is stuck from one that is simply pressed against
/// something, or has found its hole. So it searches once, for two seconds or until nothing holds the part any more; and
/// again only when the target has moved by a millimetre, which ends a search, too. Deterministic. Not thread-safe.
class SpiralSearch {
 public:
  /// For a part of the given radius (metres).
  explicit SpiralSearch(double radius) : radius_(radius) {}

  /// Notes the outcome of a call of `advance` over `milliseconds`: the target, the displacement `error` from the part
  /// to it, the metres that the part `moved`, and whether contacts held it.
  void observe(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref, const geometry::Displacement& error,
               double moved, bool is_held, double milliseconds);

  bool is_searching() const { return is_searching_; }

  /// The pose to aim at: X_WT, or during a search a pose beside it and tilted, by up to 1.6 mm and 1.4° after two
  /// seconds. The aim goes round ten times a second, across the direction of the target at the moment the part got
  /// stuck.
  Eigen::Isometry3d aim(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const;

 private:
  bool is_elsewhere(const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref) const;

  double radius_;
  bool is_searching_ = false;
  bool has_begun_ = false;  // a search for the target X_WT_
  double still_ms_ = 0.0;
  double searched_ms_ = 0.0;
  geometry::Displacement stuck_;                            // the error when the part got stuck
  Eigen::Isometry3d X_WT_ = Eigen::Isometry3d::Identity();  // its target then
};

}  // namespace glissade::contact
