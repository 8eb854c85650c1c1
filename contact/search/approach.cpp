#include "search/approach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <glissade/base/assert.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

void copy_mover_poses(const ContactScene& scene, std::vector<Eigen::Isometry3d>& X_WB) {
  X_WB.clear();
  for (const PlacedBody& mover : scene.bodies().subspan(scene.obstacles().size()))
    X_WB.push_back(mover.X_WB);
}

bool are_rigid(std::span<const Eigen::Isometry3d> poses) {
  return std::all_of(poses.begin(), poses.end(), [](const auto& X) { return geometry::rigid_pose(X).has_value(); });
}

double approach(const ContactScene& scene, std::span<const Eigen::Isometry3d> X_WB_begin,
                std::span<const Eigen::Isometry3d> X_WB_end, std::vector<BoundedMotion>& motions) {
  GLISSADE_ASSERT(X_WB_begin.size() == X_WB_end.size());
  motions.resize(scene.bodies().size());
  double farthest = 0.0;
  double farthest_of_others = 0.0;  // than the unit of the body that moved farthest
  std::optional<std::int32_t> unit;
  for (std::size_t mover = 0; mover < X_WB_begin.size(); ++mover) {
    const std::size_t body = scene.body_of_mover(mover);
    if (X_WB_begin[mover].matrix() == X_WB_end[mover].matrix()) {
      motions[body] = {};
      continue;
    }
    const SlidingPart& part = *scene.movers()[mover];
    const geometry::Displacement d = geometry::displacement_between(X_WB_begin[mover], X_WB_end[mover], part.p_Vref());
    const double all = geometry::motion_bound(d, part.radius());
    motions[body] = {d.v, all - d.v.norm()};
    if (!std::isfinite(all)) return std::numeric_limits<double>::infinity();
    const std::int32_t own_unit = scene.unit(static_cast<std::int32_t>(body));
    if (all > farthest) {
      if (unit != own_unit) farthest_of_others = farthest;
      farthest = all;
      unit = own_unit;
    } else if (unit != own_unit) {
      farthest_of_others = std::max(farthest_of_others, all);
    }
  }
  return farthest + farthest_of_others;
}

}  // namespace glissade::contact
