#include <vector>

#include <glissade/apps/scene/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/collision/dop_query.h>

namespace glissade::apps {

namespace {

/// The objects that a part overlaps.
struct Overlaps {
  std::string text;
  bool with_obstacle = false;
};

Overlaps overlaps_of(std::size_t part, const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                     std::span<const Eigen::Isometry3d> moving_X_WB) {
  collision::QueryWorkspace workspace;
  Overlaps overlaps;
  const auto look_at = [&](const collision::DopTree& tree, const Eigen::Isometry3d& X_WB, const std::string& name) {
    const Eigen::Isometry3d X_BV = X_WB.inverse(Eigen::Isometry) * X_WV[part];
    const double depth = collision::find_way_out(tree, scene.parts[part].part_V->tree, X_BV, workspace).depth();
    if (depth == 0.0) return;
    overlaps.text += (overlaps.text.empty() ? "at most " : ", ") + rounded_text(1e3 * depth) + " mm deep in " + name;
  };
  for (const haptics::Obstacle& obstacle : scene.obstacles)
    look_at(obstacle.body->tree, obstacle.X_WO, obstacle.name);
  overlaps.with_obstacle = !overlaps.text.empty();
  for (std::size_t other = 0; other < part; ++other)
    look_at(scene.parts[other].part_V->tree, X_WV[other], in_quotes(scene.parts[other].name));
  for (std::size_t i = 0; i < scene.moving.size(); ++i)
    look_at(scene.moving[i].part_B->tree, moving_X_WB[i], scene.moving[i].name);
  return overlaps;
}

}  // namespace

std::string overlap_advice(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                           std::span<const Eigen::Isometry3d> moving_X_WB, bool may_depenetrate) {
  for (std::size_t part = 0; part < scene.parts.size(); ++part) {
    const Overlaps overlaps = overlaps_of(part, scene, X_WV, moving_X_WB);
    if (overlaps.text.empty()) continue;
    return ": " + overlaps.text +
           (may_depenetrate && overlaps.with_obstacle
                ? "; begin elsewhere, or let --depenetrate push the part out of obstacles"
                : "");
  }
  return "";
}

std::string overlap_advice(const HapticScene& scene, bool may_depenetrate) {
  std::vector<Eigen::Isometry3d> X_WV;
  for (const ScenePart& part : scene.parts)
    X_WV.push_back(part.X_WV_start);
  std::vector<Eigen::Isometry3d> moving_X_WB;
  for (const haptics::ScriptedPart& part : scene.moving)
    moving_X_WB.push_back(part.script_X_WB.pose_at(part.start));
  return overlap_advice(scene, X_WV, moving_X_WB, may_depenetrate);
}

}  // namespace glissade::apps
