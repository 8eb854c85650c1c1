#include <algorithm>
#include <utility>
#include <vector>

#include <glissade/apps/scene/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/collision/dop_query.h>
#include <glissade/contact/multi_part_sliding.h>

namespace glissade::apps {

namespace {

/// The objects that a part touches or overlaps.
struct Overlaps {
  std::string text;
  double depth = 0.0;  ///< metres, the greatest
  bool with_obstacle = false;
};

Overlaps overlaps_of(std::size_t part, const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                     std::span<const Eigen::Isometry3d> moving_X_WB) {
  const contact::SlidingPart& part_V = *scene.parts[part].part_V;
  collision::QueryWorkspace workspace;
  Overlaps overlaps;
  const auto look_at = [&](const contact::ContactBody& body, const Eigen::Isometry3d& X_WB, const std::string& name) {
    const Eigen::Isometry3d X_BV = X_WB.inverse(Eigen::Isometry) * X_WV[part];
    if (!collision::intersects(body.tree, part_V.tree, X_BV, workspace)) return;
    const double depth = contact::overlap_depth(body, part_V, X_BV);
    overlaps.depth = std::max(overlaps.depth, depth);
    overlaps.text += overlaps.text.empty() ? "" : ", ";
    overlaps.text += depth > 0.0 ? "at most " + rounded_text(1e3 * depth) + " mm deep in " + name : "touching " + name;
  };
  for (const contact::Obstacle& obstacle : scene.obstacles)
    look_at(*obstacle.body, obstacle.X_WO, obstacle.name);
  overlaps.with_obstacle = !overlaps.text.empty();
  for (std::size_t other = 0; other < part; ++other)
    look_at(*scene.parts[other].part_V, X_WV[other], in_quotes(scene.parts[other].name));
  for (std::size_t i = 0; i < scene.moving.size(); ++i)
    look_at(*scene.moving[i].part_B, moving_X_WB[i], scene.moving[i].name);
  return overlaps;
}

/// Of the part that is deepest in others.
Overlaps deepest_overlaps(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                          std::span<const Eigen::Isometry3d> moving_X_WB) {
  Overlaps deepest;
  for (std::size_t part = 0; part < X_WV.size(); ++part) {
    Overlaps overlaps = overlaps_of(part, scene, X_WV, moving_X_WB);
    if (deepest.text.empty() || overlaps.depth > deepest.depth) deepest = std::move(overlaps);
  }
  return deepest;
}

}  // namespace

std::string text_of_overlaps(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                             std::span<const Eigen::Isometry3d> moving_X_WB) {
  return deepest_overlaps(scene, X_WV, moving_X_WB).text;
}

std::string overlap_advice(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                           std::span<const Eigen::Isometry3d> moving_X_WB, bool may_depenetrate) {
  const Overlaps overlaps = deepest_overlaps(scene, X_WV, moving_X_WB);
  if (overlaps.text.empty()) return "";
  const bool helps = may_depenetrate && overlaps.with_obstacle;
  return ": " + overlaps.text + (helps ? "; begin elsewhere, or let --depenetrate push the part out of obstacles" : "");
}

std::string overlap_advice(const HapticScene& scene, bool may_depenetrate) {
  std::vector<Eigen::Isometry3d> X_WV;
  for (const ScenePart& part : scene.parts)
    X_WV.push_back(part.X_WV_start);
  std::vector<Eigen::Isometry3d> moving_X_WB;
  for (const contact::ScriptedPart& part : scene.moving)
    moving_X_WB.push_back(part.script_X_WB.pose_at(part.start));
  return overlap_advice(scene, X_WV, moving_X_WB, may_depenetrate);
}

}  // namespace glissade::apps
