#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>

#include <glissade/apps/files/pose_rules.h>
#include <glissade/apps/scene/haptic_scene.h>
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

std::shared_ptr<const contact::SlidingPart> make_part(const Scene& scene, const SceneObject& object) {
  if (object.compliance_point_B) return make_body<contact::SlidingPart>(scene, object, *object.compliance_point_B);
  return make_body<contact::SlidingPart>(scene, object);
}

/// Objects of one mesh share their body.
class Bodies {
 public:
  explicit Bodies(const Scene& scene) : scene_(scene) {}

  std::shared_ptr<const contact::ContactBody> of(const SceneObject& object) {
    if (!object.giving_way.empty()) return make_body<contact::ContactBody>(scene_, object);
    std::shared_ptr<const contact::ContactBody>& body = bodies_[object.mesh.get()];
    if (!body) body = make_body<contact::ContactBody>(scene_, object);
    return body;
  }

 private:
  const Scene& scene_;
  std::map<const geometry::TriangleMesh*, std::shared_ptr<const contact::ContactBody>> bodies_;
};

}  // namespace

std::optional<std::size_t> HapticScene::part_number(const std::string& name) const {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].name == name) return p;
  }
  return std::nullopt;
}

std::string HapticScene::part_names() const {
  std::string names;
  for (const ScenePart& part : parts)
    names += (names.empty() ? "" : ", ") + in_quotes(part.name);
  return names;
}

HapticScene make_haptic_scene(const Scene& scene, const std::vector<std::string>& part_names) {
  HapticScene result;
  result.source = scene.source;
  result.X_WGoal = scene.X_WGoal;
  result.shown = shown_objects(scene, part_names);
  for (const SceneObject& object : scene.objects)
    check(scene, object);
  for (const std::string& name : part_names) {
    const SceneObject& part = scene.find(name);
    if (part.motion) {
      throw std::invalid_argument(scene.source + ": object " + in_quotes(part.name) +
                                  " moves on its own, so it cannot be a part in a hand");
    }
    result.parts.push_back({part.name, make_part(scene, part), part.X_WB});
  }

  Bodies bodies(scene);
  for (const SceneObject& object : scene.objects) {
    if (result.part_number(object.name) || object.motion) continue;
    result.obstacles.push_back({bodies.of(object), object.X_WB, in_quotes(object.name), object.margin_m});
    result.body_names.push_back(object.name);
    result.placed_obstacles.push_back({holding(object), object.X_WB});
  }
  for (const ScenePart& part : result.parts)
    result.body_names.push_back(part.name);
  for (const SceneObject& object : scene.objects) {
    if (!object.motion) continue;
    contact::ScriptedPart& moving =
        result.moving.emplace_back(contact::ScriptedPart{make_part(scene, object), object.motion->script_X_WB});
    moving.grip_N_per_m = object.motion->grip_N_per_m.value_or(moving.grip_N_per_m);
    moving.name = in_quotes(object.name);
    result.body_names.push_back(object.name);
  }
  const std::size_t count = result.parts.size() + result.moving.size();
  if (count > contact::kMaxParts) {
    throw std::invalid_argument(scene.source + ": " + std::to_string(count) +
                                " objects are in a hand or move on their own; at most " +
                                std::to_string(contact::kMaxParts) + " can");
  }
  if (result.obstacles.empty() && count == 1) {
    throw std::invalid_argument(scene.source + ": there is nothing but the part " + result.part_names() +
                                " in the scene");
  }
  return result;
}

std::vector<viewer::ViewObject> shown_objects(const Scene& scene, const std::vector<std::string>& part_names) {
  std::vector<viewer::ViewObject> objects;
  std::size_t next = part_names.size();
  for (const SceneObject& object : scene.objects) {
    viewer::ViewObject& shown = objects.emplace_back(viewer::ViewObject{object.name, object.mesh, object.X_WB});
    const auto name = std::find(part_names.begin(), part_names.end(), object.name);
    if (name != part_names.end()) shown.part = static_cast<std::size_t>(name - part_names.begin());
    shown.moves_on_its_own = object.motion.has_value();
    if (object.motion) shown.part = next++;
  }
  return objects;
}

std::vector<std::string> movable_objects(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (object.movable) names.push_back(object.name);
  }
  if (!names.empty()) return names;
  throw std::invalid_argument(scene.source + ": no object is movable; a hand needs a part to hold ('movable: true')");
}

std::vector<contact::HeldPart> held_parts(const HapticScene& scene, const SlidingChoice& choice) {
  std::vector<contact::HeldPart> parts;
  for (const ScenePart& part : scene.parts) {
    parts.push_back({.part_V = part.part_V,
                     .X_WV_start = part.X_WV_start,
                     .metaphor = metaphor_of(choice),
                     .stiffness = stiffness_of(choice, part.part_V->radius()),
                     .name = "object " + in_quotes(part.name)});
  }
  for (const contact::ScriptedPart& part : scene.moving)
    parts.push_back(held_by_script(part));
  return parts;
}

void check_names_fit_csv(const HapticScene& scene) {
  for (const std::string& name : scene.body_names) {
    if (!scene.part_number(name)) check_name_fits_csv(scene, name);  // no row names a part
  }
}

void check_name_fits_csv(const HapticScene& scene, const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return;
  throw std::invalid_argument(scene.source + ": object " + in_quotes(name) +
                              " has a comma, quote or line break in its name, which a CSV file cannot hold");
}

}  // namespace glissade::apps
