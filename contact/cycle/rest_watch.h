#pragma once

/// Notices a part that finds no rest though nothing leads it elsewhere. Contacts that bend may lead a part in a circle:
/// the step that gives one contact its margin back takes it from another one.

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

namespace glissade::contact {

/// Deterministic. Not thread-safe.
class RestWatch {
 public:
  /// Notes a call of `advance` over `milliseconds`: the poses of the part and its target after it, and whether the part
  /// moved in it, if only to and fro. All its points are within `lever` metres of its reference point p_Vref.
  void observe(const Eigen::Isometry3d& X_WV, const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& p_Vref,
               double lever, bool moved, double milliseconds);

  /// Whether neither the target nor the part has got anywhere for 0.2 s; a restless part may.
  bool stays() const { return stays_; }
  /// Whether the part goes to and fro all the same. Then this lasts until the target gets somewhere.
  bool is_restless() const { return is_restless_; }

 private:
  Eigen::Isometry3d X_WV_ = Eigen::Isometry3d::Identity();  // since `here_ms_`
  Eigen::Isometry3d X_WT_ = Eigen::Isometry3d::Identity();
  double here_ms_ = 0.0;
  bool stays_ = false;
  bool is_restless_ = false;
};

}  // namespace glissade::contact
