#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>

#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/pose_rules.h>
#include <glissade/apps/text.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::apps {

namespace {

/// Whether the mesh has area at its pose: far from the origin, rounding can collapse a small object.
bool has_area(const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_WB) {
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    if (!geometry::is_degenerate({X_WB * mesh.corner(t, 0), X_WB * mesh.corner(t, 1), X_WB * mesh.corner(t, 2)})) {
      return true;
    }
  }
  return false;
}

/// Throws when an object at its pose cannot be simulated.
void check(const Scene& scene, const SceneObject& object) {
  const std::string where = scene.source + ": object " + in_quotes(object.name);
  for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
    if (((object.X_WB * object.mesh->vertices[i]).array().abs() <= kLargestCoordinate_m).all()) continue;
    throw std::invalid_argument(where + ": vertex " + std::to_string(i) + " lies beyond ±1e9 m");
  }
  if (!has_area(*object.mesh, object.X_WB)) {
    throw std::invalid_argument(where + ": the mesh has no triangle of positive area");
  }
}

/// The mesh without the triangles that give way.
std::shared_ptr<const geometry::TriangleMesh> holding(const SceneObject& object) {
  if (object.giving_way.empty()) return object.mesh;
  return std::make_shared<geometry::TriangleMesh>(geometry::without_triangles(*object.mesh, object.giving_way));
}

/// The body of an object, made of what follows it. An error names the object.
template <typename Body, typename... Arguments>
std::shared_ptr<const Body> make_body(const Scene& scene, const SceneObject& object, const Arguments&... arguments) {
  try {
    return std::make_shared<Body>(holding(object), arguments...);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": object " + in_quotes(object.name) + ": " + error.what());
  }
}

std::shared_ptr<const haptics::SlidingPart> make_part(const Scene& scene, const SceneObject& object) {
  if (object.compliance_point_B) return make_body<haptics::SlidingPart>(scene, object, *object.compliance_point_B);
  return make_body<haptics::SlidingPart>(scene, object);
}

/// Objects of one mesh share their body.
class Bodies {
 public:
  explicit Bodies(const Scene& scene) : scene_(scene) {}

  std::shared_ptr<const haptics::ContactBody> of(const SceneObject& object) {
    if (!object.giving_way.empty()) return make_body<haptics::ContactBody>(scene_, object);
    std::shared_ptr<const haptics::ContactBody>& body = bodies_[object.mesh.get()];
    if (!body) body = make_body<haptics::ContactBody>(scene_, object);
    return body;
  }

 private:
  const Scene& scene_;
  std::map<const geometry::TriangleMesh*, std::shared_ptr<const haptics::ContactBody>> bodies_;
};

}  // namespace

HapticScene make_haptic_scene(const Scene& scene, const std::string& part_name) {
  const SceneObject& part = scene.find(part_name);
  if (part.motion) {
    throw std::invalid_argument(scene.source + ": object " + in_quotes(part.name) +
                                " moves on its own, so it cannot be the part in the hand");
  }
  const auto movers = std::count_if(scene.objects.begin(), scene.objects.end(),
                                    [](const SceneObject& object) { return object.motion.has_value(); });
  if (movers >= static_cast<std::ptrdiff_t>(haptics::kMaxParts)) {
    throw std::invalid_argument(scene.source + ": " + std::to_string(movers) + " objects move on their own; at most " +
                                std::to_string(haptics::kMaxParts - 1) + " can");
  }
  for (const SceneObject& object : scene.objects)
    check(scene, object);
  HapticScene result;
  result.source = scene.source;
  result.part_name = part.name;
  result.part_V = make_part(scene, part);
  result.X_WV_start = part.X_WB;
  result.X_WGoal = scene.X_WGoal;

  Bodies bodies(scene);
  for (const SceneObject& object : scene.objects) {
    if (object.name == part.name || object.motion) continue;
    result.obstacles.push_back({bodies.of(object), object.X_WB, in_quotes(object.name), object.margin_m});
    result.body_names.push_back(object.name);
    result.placed_obstacles.push_back({holding(object), object.X_WB});
  }
  result.body_names.push_back(part.name);
  for (const SceneObject& object : scene.objects) {
    if (!object.motion) continue;
    haptics::ScriptedPart& moving =
        result.moving.emplace_back(haptics::ScriptedPart{make_part(scene, object), object.motion->script_X_WB});
    moving.grip_N_per_m = object.motion->grip_N_per_m.value_or(moving.grip_N_per_m);
    moving.name = in_quotes(object.name);
    result.body_names.push_back(object.name);
  }
  if (result.obstacles.empty() && result.moving.empty()) {
    throw std::invalid_argument(scene.source + ": there is nothing but the part '" + part.name + "' in the scene");
  }
  return result;
}

std::string only_movable_object(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (object.movable) names.push_back(object.name);
    if (!object.motion) continue;
    throw std::invalid_argument(scene.source + ": object " + in_quotes(object.name) +
                                " moves on its own, which only 'glissade slide' can simulate yet");
  }
  if (names.size() == 1) return names.front();
  throw std::invalid_argument(scene.source + ": one object must be movable, the part in the hand, but " +
                              std::to_string(names.size()) + " are");
}

void check_names_fit_csv(const HapticScene& scene) {
  for (std::size_t body = 0; body < scene.body_names.size(); ++body) {
    const std::string& name = scene.body_names[body];
    if (body == scene.obstacles.size()) continue;  // the part, which no row names
    if (name.find_first_of(",\"\n\r") == std::string::npos) continue;
    throw std::invalid_argument(scene.source + ": object " + in_quotes(name) +
                                " has a comma, quote or line break in its name, which a CSV file cannot hold");
  }
}

}  // namespace glissade::apps
