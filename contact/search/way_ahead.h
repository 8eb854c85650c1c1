#pragma once

/// Where the parts will be, if they go on as they went.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "scene/contact_scene.h"
#include "search/approach.h"

namespace glissade::contact {

/// Not thread-safe.
class WayAhead {
 public:
  /// The scene must outlive this object.
  explicit WayAhead(const ContactScene& scene) : scene_(scene) {}

  /// To be called when the answer of a search has been taken, with the present poses of the movers.
  void begin(std::span<const Eigen::Isometry3d> X_WB) {
    X_WB_at_taking_before_.swap(X_WB_at_taking_);
    X_WB_at_taking_.assign(X_WB.begin(), X_WB.end());
    if (X_WB_at_taking_before_.empty()) X_WB_at_taking_before_ = X_WB_at_taking_;
  }
  /// To be called where the movers have not gone from there, but jumped.
  void forget() {
    X_WB_at_taking_.clear();
    X_WB_at_taking_before_.clear();
  }

  /// Replaces `X_WB` by the poses of the movers after `way` more metres: they go on as since they were at
  /// `X_WB_nearest`, where they were nearest to the poses of the last search. Poses that a search refuses, and those of
  /// movers that have gone nowhere, are the present ones.
  void follow(std::span<const Eigen::Isometry3d> X_WB_nearest, double way, std::vector<Eigen::Isometry3d>& X_WB);
  /// The same: they go on as since the answer before the last one was taken. So their way can be told as soon as an
  /// answer has been taken. Returns false for poses that a search refuses, and where the movers have gone nowhere.
  bool follow_far(double way, std::vector<Eigen::Isometry3d>& X_WB);

 private:
  bool go_on(std::span<const Eigen::Isometry3d> X_WB_before, double way, std::vector<Eigen::Isometry3d>& X_WB);

  const ContactScene& scene_;
  std::vector<Eigen::Isometry3d> X_WB_at_taking_;
  std::vector<Eigen::Isometry3d> X_WB_at_taking_before_;
  std::vector<BoundedMotion> motions_;  // scratch memory
};

/// Displaces each mover of `X_WB` by a `share` of the displacement of the part with which it moves. `way` has one for
/// each part.
void displace_movers(const ContactScene& scene, std::span<const geometry::Displacement> way, double share,
                     std::vector<Eigen::Isometry3d>& X_WB);

}  // namespace glissade::contact
