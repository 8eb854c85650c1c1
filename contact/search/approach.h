#pragma once

/// How much nearer to each other the bodies of a scene come, at most, while the movers go from some poses to others.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// The motion of a body: each point moves by v_W, with a deviation of at most `turn`.
struct BoundedMotion {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< metres
  double turn = 0.0;                              ///< metres
};

/// Replaces `X_WB` by the present poses of the movers.
void copy_mover_poses(const ContactScene& scene, std::vector<Eigen::Isometry3d>& X_WB);

/// Whether all poses are such as a search accepts. Going on from others would make them rigid.
bool are_rigid(std::span<const Eigen::Isometry3d> poses);

/// Bound (metres) of how much nearer two bodies come while each mover goes from its pose of `X_WB_begin` to that of
/// `X_WB_end`; infinite for a pose that is not finite. Two bodies come nearer by their motions. Those of one unit keep
/// their distance, or do not matter. Sets `motions`, one of each body, which are about the movers' reference points;
/// those of a call that returned infinity are incomplete. Only for one scene may `motions` be used again.
double approach(const ContactScene& scene, std::span<const Eigen::Isometry3d> X_WB_begin,
                std::span<const Eigen::Isometry3d> X_WB_end, std::vector<BoundedMotion>& motions);

}  // namespace glissade::contact
