#include "bodies/scene_bodies.h"

#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::simulation {
namespace {

using files::in_quotes;

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
  if (object.mesh.shared() == nullptr) throw std::invalid_argument(named(scene, object) + " has no mesh");
  for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
    if (((object.X_WB * object.mesh->vertices[i]).array().abs() <= files::kLargestCoordinate_m).all()) continue;
    throw std::invalid_argument(named(scene, object) + ": vertex " + std::to_string(i) + " lies beyond ±1e9 m");
  }
  const auto count = static_cast<std::int32_t>(object.mesh->triangles.size());
  std::int32_t last = -1;
  for (const std::int32_t triangle : object.giving_way) {
    if (triangle <= last || triangle >= count)
      throw std::invalid_argument(named(scene, object) + ": triangle " + std::to_string(triangle) +
                                  " cannot give way: the numbers must ascend, and lie below " + std::to_string(count));
    last = triangle;
  }
  if (!has_area(*object.mesh, object.X_WB)) {
    throw std::invalid_argument(named(scene, object) + ": the mesh has no triangle of positive area");
  }
}

/// The body of an object, made of what follows it. An error names the object.
template <typename Body, typename... Arguments>
std::shared_ptr<const Body> make_body(const Scene& scene, const SceneObject& object, const Arguments&... arguments) {
  try {
    return std::make_shared<Body>(stopping_mesh(object), arguments...);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(named(scene, object) + ": " + error.what());
  }
}

/// The part with this mesh and compliance point; null if there is none.
std::shared_ptr<const contact::SlidingPart> known_part(std::span<const SceneBodies> known, const SceneObject& object) {
  const auto is_same = [&](const contact::SlidingPart& part) {
    if (&part.tree.mesh() != object.mesh.shared().get()) return false;
    if (!object.compliance_point_B) return !part.has_chosen_point();
    return part.has_chosen_point() && part.p_Vref() == *object.compliance_point_B;
  };
  for (const SceneBodies& bodies : known) {
    for (const ScenePart& part : bodies.parts) {
      if (is_same(*part.part_V)) return part.part_V;
    }
    for (const contact::ScriptedPart& part : bodies.moving) {
      if (is_same(*part.part_B)) return part.part_B;
    }
  }
  return nullptr;
}

std::shared_ptr<const contact::SlidingPart> make_part(const Scene& scene, const SceneObject& object,
                                                      std::span<const SceneBodies> known) {
  if (auto part = known_part(known, object)) return part;
  if (object.compliance_point_B) return make_body<contact::SlidingPart>(scene, object, *object.compliance_point_B);
  return make_body<contact::SlidingPart>(scene, object);
}

/// Objects of one mesh share their body.
class SharedBodies {
 public:
  SharedBodies(const Scene& scene, std::span<const SceneBodies> known) : scene_(scene) {
    for (const SceneBodies& bodies : known) {
      for (const contact::Obstacle& obstacle : bodies.obstacles)
        bodies_.emplace(&obstacle.body->tree.mesh(), obstacle.body);
    }
  }

  std::shared_ptr<const contact::ContactBody> of(const SceneObject& object) {
    if (!object.giving_way.empty()) return make_body<contact::ContactBody>(scene_, object);
    std::shared_ptr<const contact::ContactBody>& body = bodies_[object.mesh.shared().get()];
    if (!body) body = make_body<contact::ContactBody>(scene_, object);
    return body;
  }

 private:
  const Scene& scene_;
  std::map<const geometry::TriangleMesh*, std::shared_ptr<const contact::ContactBody>> bodies_;
};

contact::ScriptedPart moving_part(const Scene& scene, const SceneObject& object, std::span<const SceneBodies> known) {
  contact::ScriptedPart part{make_part(scene, object, known), object.motion->script_X_WB};
  part.grip_N_per_m = object.motion->grip_N_per_m.value_or(part.grip_N_per_m);
  part.name = in_quotes(object.name);
  return part;
}

void check_counts(const SceneBodies& bodies) {
  const std::size_t count = bodies.parts.size() + bodies.moving.size();
  if (count > contact::kMaxParts) {
    throw std::invalid_argument(bodies.source + ": " + std::to_string(count) +
                                " objects are in a hand or move on their own; at most " +
                                std::to_string(contact::kMaxParts) + " can");
  }
  if (bodies.obstacles.empty() && count == 1) {
    throw std::invalid_argument(bodies.source + ": there is nothing but the part " + bodies.part_names() +
                                " in the scene");
  }
}

}  // namespace

std::string named(const Scene& scene, const SceneObject& object) {
  return scene.source + ": object " + in_quotes(object.name);
}

void check_scene(const Scene& scene) {
  std::set<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (!names.insert(object.name).second)
      throw std::invalid_argument(named(scene, object) + ": another object has the same name");
    check(scene, object);
  }
}

std::vector<std::shared_ptr<const grasping::HandModel>> hand_models(std::span<const grasping::HandShape> hands) {
  std::map<std::tuple<double, double, hands::HandSide>, std::shared_ptr<const grasping::HandModel>> known;
  std::vector<std::shared_ptr<const grasping::HandModel>> models;
  for (const grasping::HandShape& shape : hands) {
    auto& model = known[{shape.length_m, shape.breadth_m, shape.side}];
    if (!model) model = std::make_shared<const grasping::HandModel>(grasping::make_hand(shape));
    models.push_back(model);
  }
  return models;
}

std::shared_ptr<const geometry::TriangleMesh> stopping_mesh(const SceneObject& object) {
  if (object.giving_way.empty()) return object.mesh.shared();
  return std::make_shared<geometry::TriangleMesh>(geometry::without_triangles(*object.mesh, object.giving_way));
}

SceneBodies bodies_of(const Scene& scene, const std::vector<std::string>& part_names,
                      std::span<const SceneBodies> known) {
  check_scene(scene);
  SceneBodies bodies{.source = scene.source, .X_WGoal = scene.X_WGoal};
  for (const std::string& name : part_names) {
    const SceneObject& part = scene.find(name);
    if (part.motion)
      throw std::invalid_argument(named(scene, part) + " moves on its own, so it cannot be a part in a hand");
    if (bodies.part_number(name)) throw std::invalid_argument(named(scene, part) + " is named twice among the parts");
    bodies.parts.push_back({part.name, make_part(scene, part, known), part.X_WB});
  }
  SharedBodies shared(scene, known);
  for (const SceneObject& object : scene.objects) {
    if (bodies.part_number(object.name) || object.motion) continue;
    bodies.obstacles.push_back({shared.of(object), object.X_WB, in_quotes(object.name), object.margin_m});
    bodies.body_names.push_back(object.name);
  }
  for (const ScenePart& part : bodies.parts)
    bodies.body_names.push_back(part.name);
  for (const SceneObject& object : scene.objects) {
    if (!object.motion) continue;
    bodies.moving.push_back(moving_part(scene, object, known));
    bodies.body_names.push_back(object.name);
  }
  check_counts(bodies);
  return bodies;
}

std::vector<contact::HeldPart> held_parts(const SceneBodies& bodies, contact::Metaphor metaphor,
                                          double stiffness_N_per_m) {
  std::vector<contact::HeldPart> parts;
  for (const ScenePart& part : bodies.parts) {
    parts.push_back({.part_V = part.part_V,
                     .X_WV_start = part.X_WV_start,
                     .metaphor = metaphor,
                     .stiffness = contact::stiffness_of_part(part.part_V->radius(), stiffness_N_per_m),
                     .name = "object " + in_quotes(part.name)});
  }
  for (const contact::ScriptedPart& part : bodies.moving)
    parts.push_back(contact::held_by_script(part));
  return parts;
}

}  // namespace glissade::simulation
