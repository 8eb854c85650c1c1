#include "search/way_ahead.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace glissade::contact {
namespace {

/// Of the way that they have gone so far: the parts are expected to go on so for as long at most.
constexpr double kMostForward = 3.0;

}  // namespace

void WayAhead::follow(std::span<const Eigen::Isometry3d> X_WB_nearest, double way,
                      std::vector<Eigen::Isometry3d>& X_WB) {
  copy_mover_poses(scene_, X_WB);
  if (!(way > 0.0)) return;
  // If the parts are about there, their last steps may be small corrections.
  const bool is_far_enough = !(kMostForward * approach(scene_, X_WB_nearest, X_WB, motions_) < way);
  go_on(is_far_enough ? X_WB_nearest : X_WB_at_taking_, way, X_WB);
}

bool WayAhead::follow_far(double way, std::vector<Eigen::Isometry3d>& X_WB) {
  copy_mover_poses(scene_, X_WB);
  return go_on(X_WB_at_taking_before_, way, X_WB);
}

/// The movers, at X_WB now, were at `X_WB_before`.
bool WayAhead::go_on(std::span<const Eigen::Isometry3d> X_WB_before, double way, std::vector<Eigen::Isometry3d>& X_WB) {
  const double gone = approach(scene_, X_WB_before, X_WB, motions_);
  if (!(gone > 0.0) || !std::isfinite(gone)) return false;
  if (!are_rigid(X_WB)) return false;
  const double share = std::min(kMostForward, way / gone);
  for (std::size_t mover = 0; mover < X_WB.size(); ++mover) {
    const Eigen::Vector3d& p_Bref = scene_.movers()[mover]->p_Vref();
    const geometry::Displacement d = geometry::displacement_between(X_WB_before[mover], X_WB[mover], p_Bref);
    if (!d.is_zero()) X_WB[mover] = geometry::displaced(X_WB[mover], p_Bref, d.scaled(share));
  }
  return true;
}

void displace_movers(const ContactScene& scene, std::span<const geometry::Displacement> way, double share,
                     std::vector<Eigen::Isometry3d>& X_WB) {
  for (std::size_t mover = 0; mover < X_WB.size(); ++mover) {
    const std::int32_t leader = scene.leader(static_cast<std::int32_t>(scene.body_of_mover(mover)));
    if (leader == ContactScene::kStands) continue;
    const geometry::Displacement d = way[static_cast<std::size_t>(leader)].scaled(share);
    if (!d.is_zero()) X_WB[mover] = geometry::displaced(X_WB[mover], scene.p_Bref(mover), d);
  }
}

}  // namespace glissade::contact
