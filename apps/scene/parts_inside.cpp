#include <glissade/apps/scene/parts_inside.h>
#include <glissade/apps/text.h>
#include <glissade/contact/multi_part_sliding.h>

namespace glissade::apps {

std::vector<std::string> parts_inside(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV) {
  std::vector<std::string> sentences;
  for (std::size_t p = 0; p < X_WV.size(); ++p) {
    for (const contact::Obstacle& obstacle : scene.obstacles) {
      const Eigen::Isometry3d X_OV = obstacle.X_WO.inverse(Eigen::Isometry) * X_WV[p];
      if (!contact::is_enclosed(*obstacle.body, *scene.parts[p].part_V, X_OV)) continue;
      sentences.push_back("part " + in_quotes(scene.parts[p].name) + " starts inside the closed surface of " +
                          obstacle.name + ", and cannot get out");
    }
  }
  return sentences;
}

std::vector<std::string> parts_inside(const HapticScene& scene) {
  std::vector<Eigen::Isometry3d> X_WV;
  for (const ScenePart& part : scene.parts)
    X_WV.push_back(part.X_WV_start);
  return parts_inside(scene, X_WV);
}

}  // namespace glissade::apps
