#include <limits>
#include <span>
#include <vector>

#include <glissade/apps/text.h>
#include <glissade/apps/view/waiting_hand.h>
#include <glissade/collision/dop_query.h>

namespace glissade::apps {

std::string nearest_object(const HapticScene& scene, const grasping::GraspSimulation& simulation,
                           const grasping::HandModel& hand, grasping::Posture posture) {
  hand.chain.clamp(posture.values);
  const std::span<const grasping::ChainLink> links = hand.chain.links();
  std::vector<Eigen::Isometry3d> X_WL(links.size());
  hand.chain.poses(posture.X_WR, posture.values, X_WL);
  collision::QueryWorkspace workspace;
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (std::size_t link = 0; link < links.size(); ++link) {
    if (!links[link].mesh) continue;
    const collision::DopTree segment(links[link].mesh);
    const auto look_at = [&](const collision::DopTree& tree, const Eigen::Isometry3d& X_WB, const std::string& name) {
      const Eigen::Isometry3d X_BL = X_WB.inverse(Eigen::Isometry) * X_WL[link];
      const double distance = collision::distance(tree, segment, X_BL, workspace, least).distance;
      if (!(distance < least)) return;
      least = distance;
      text = links[link].name + " in " + in_quotes(name);
    };
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i)
      look_at(scene.obstacles[i].body->tree, scene.obstacles[i].X_WO, scene.body_names[i]);
    for (std::size_t p = 0; p < simulation.part_count(); ++p) {
      look_at(simulation.parts().part(p).tree, simulation.parts().result(p).X_WV,
              scene.body_names[scene.obstacles.size() + p]);
    }
  }
  return text;
}

}  // namespace glissade::apps
