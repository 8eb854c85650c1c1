#include <stdexcept>

#include <glissade/apps/haptic_scene.h>
#include <glissade/collision/mesh_operations.h>

namespace glissade::apps {

HapticScene make_haptic_scene(const Scene& scene, const std::string& part_name) {
  const SceneObject& part = scene.find(part_name);
  HapticScene result;
  result.part_name = part.name;
  result.part_V = std::make_shared<haptics::SlidingPart>(part.mesh);
  result.X_WV_start = part.X_WB;
  result.X_WGoal = scene.X_WGoal;

  std::vector<collision::TriangleMesh> meshes_W;
  for (const SceneObject& object : scene.objects) {
    if (object.name == part.name) continue;
    meshes_W.push_back(collision::transformed(*object.mesh, object.X_WB));
    result.placed_obstacles.push_back({object.mesh, object.X_WB});
  }
  if (meshes_W.empty()) {
    throw std::invalid_argument(scene.source + ": there is nothing but the part '" + part.name + "' in the scene");
  }
  result.obstacles_W =
      std::make_shared<haptics::ContactBody>(std::make_shared<collision::TriangleMesh>(collision::merge(meshes_W)));
  return result;
}

std::string only_movable_object(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (object.movable) names.push_back(object.name);
  }
  if (names.size() == 1) return names.front();
  throw std::invalid_argument(scene.source + ": one object must be movable, the part in the hand, but " +
                              std::to_string(names.size()) + " are");
}

}  // namespace glissade::apps
