#include <glissade/apps/commands/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/collision/dop_query.h>

namespace glissade::apps {

std::string overlaps_at(const HapticScene& scene, const Eigen::Isometry3d& X_WV,
                        std::span<const Eigen::Isometry3d> moving_X_WB) {
  collision::QueryWorkspace workspace;
  std::string text;
  const auto look_at = [&](const collision::DopTree& tree, const Eigen::Isometry3d& X_WB, const std::string& name) {
    const double depth =
        collision::find_way_out(tree, scene.parts.front().part_V->tree, X_WB.inverse(Eigen::Isometry) * X_WV, workspace)
            .depth();
    if (depth == 0.0) return;
    text += (text.empty() ? "" : ", ") + rounded_text(1e3 * depth) + " mm deep in " + name;
  };
  for (const haptics::Obstacle& obstacle : scene.obstacles)
    look_at(obstacle.body->tree, obstacle.X_WO, obstacle.name);
  for (std::size_t i = 0; i < scene.moving.size(); ++i)
    look_at(scene.moving[i].part_B->tree, moving_X_WB[i], scene.moving[i].name);
  return text;
}

}  // namespace glissade::apps
