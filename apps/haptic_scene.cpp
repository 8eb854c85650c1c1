#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/collision/mesh_operations.h>
#include <glissade/collision/triangle_intersection.h>

namespace glissade::apps {

namespace {

constexpr double kLargestCoordinate = 1e9;

bool has_area(const collision::TriangleMesh& mesh) {
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    if (!collision::is_degenerate({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)})) return true;
  }
  return false;
}

/// The object's mesh where it lies, checked: later, in the merged mesh, nobody could tell which object is to blame.
collision::TriangleMesh placed_mesh(const Scene& scene, const SceneObject& object) {
  const std::string where = scene.source + ": object " + in_quotes(object.name);
  collision::TriangleMesh mesh_W = collision::transformed(*object.mesh, object.X_WB);
  for (std::size_t i = 0; i < mesh_W.vertices.size(); ++i) {
    if ((mesh_W.vertices[i].array().abs() <= kLargestCoordinate).all()) continue;
    throw std::invalid_argument(where + ": vertex " + std::to_string(i) + " lies beyond ±1e9 m");
  }
  if (!has_area(mesh_W)) throw std::invalid_argument(where + ": the mesh has no triangle of positive area");
  return mesh_W;
}

std::shared_ptr<const haptics::SlidingPart> make_part(const Scene& scene, const SceneObject& object) {
  placed_mesh(scene, object);
  try {
    return std::make_shared<haptics::SlidingPart>(object.mesh);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": object " + in_quotes(object.name) + ": " + error.what());
  }
}

}  // namespace

HapticScene make_haptic_scene(const Scene& scene, const std::string& part_name) {
  const SceneObject& part = scene.find(part_name);
  HapticScene result;
  result.source = scene.source;
  result.part_name = part.name;
  result.part_V = make_part(scene, part);
  result.X_WV_start = part.X_WB;
  result.X_WGoal = scene.X_WGoal;

  std::vector<collision::TriangleMesh> meshes_W;
  for (const SceneObject& object : scene.objects) {
    if (object.name == part.name) continue;
    meshes_W.push_back(placed_mesh(scene, object));
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
