// Scenes of the C interface.

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/base/require.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_model.h>

#include "call.h"
#include "convert.h"
#include "objects.h"

namespace glissade::c {

namespace {

constexpr auto kMostCount = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

/// A call that changes or reads a scene.
template <typename Work>
GlissadeStatus with_scene(GlissadeScene handle, const Work& work) noexcept {
  return call_with(scenes(), handle.id, [&](SceneObject& object) { work(object.scene); });
}

geometry::TriangleMesh mesh_of(const double* vertices, std::size_t vertex_count, const std::int32_t* triangles,
                               std::size_t triangle_count) {
  at(vertices, "vertices");
  at(triangles, "triangles");
  if (vertex_count > kMostCount || triangle_count > kMostCount)
    throw std::invalid_argument("vertex_count and triangle_count must be at most " + std::to_string(kMostCount));
  geometry::TriangleMesh mesh;
  mesh.vertices.reserve(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(vertices + 3 * v);
    if (!p.allFinite()) throw std::invalid_argument("vertices: vertex " + std::to_string(v) + " is not finite");
    mesh.vertices.push_back(p);
  }
  mesh.triangles.reserve(triangle_count);
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const geometry::Triangle triangle{triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]};
    for (const std::int32_t index : triangle) {
      if (index < 0 || static_cast<std::size_t>(index) >= vertex_count)
        throw std::invalid_argument("triangles: triangle " + std::to_string(t) + " has the vertex " +
                                    std::to_string(index) + ", but there are " + std::to_string(vertex_count));
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

void add(simulation::Scene& scene, const char* name, simulation::SceneMesh mesh, const GlissadePose* X_WB) {
  const std::string text = &at(name, "name");
  if (text.empty()) throw std::invalid_argument("name is empty");
  for (const simulation::SceneObject& object : scene.objects) {
    if (object.name == text) throw std::invalid_argument("there already is an object '" + text + "'");
  }
  simulation::SceneObject object{.name = text, .mesh = std::move(mesh)};
  if (X_WB != nullptr) object.X_WB = pose_of(*X_WB, "X_WB");
  scene.objects.push_back(std::move(object));
}

simulation::SceneObject& named(simulation::Scene& scene, const char* name) {
  const simulation::SceneObject& found = scene.find(&at(name, "name"));
  return scene.objects[static_cast<std::size_t>(&found - scene.objects.data())];
}

}  // namespace

}  // namespace glissade::c

using namespace glissade::c;
using namespace glissade;

GlissadeStatus glissade_scene_new(GlissadeScene* scene) {
  return call([&] {
    at(scene, "scene");
    scene->id = scenes().add(std::make_shared<SceneObject>());
  });
}

GlissadeStatus glissade_scene_read(const char* path, GlissadeScene* scene) {
  return call([&] {
    at(scene, "scene");
    auto object = std::make_shared<SceneObject>();
    object->scene = simulation::read_scene(&at(path, "path"));
    scene->id = scenes().add(std::move(object));
  });
}

GlissadeStatus glissade_scene_free(GlissadeScene scene) {
  return call([&] { scenes().remove(scene.id); });
}

GlissadeStatus glissade_scene_add_mesh(GlissadeScene handle, const char* name, const double* vertices,
                                       size_t vertex_count, const int32_t* triangles, size_t triangle_count,
                                       const GlissadePose* X_WB) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    add(scene, name, mesh_of(vertices, vertex_count, triangles, triangle_count), X_WB);
  });
}

GlissadeStatus glissade_scene_add_file(GlissadeScene handle, const char* name, const char* path, double scale,
                                       const GlissadePose* X_WB) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    base::require_positive("scale", scale);
    add(scene, name, simulation::SceneMesh(&at(path, "path"), scale), X_WB);
  });
}

GlissadeStatus glissade_scene_add_shape(GlissadeScene handle, const char* name, const char* type,
                                        const char* const* parameters, const double* values, size_t parameter_count,
                                        const GlissadePose* X_WB) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    array(parameters, parameter_count, "parameters");
    array(values, parameter_count, "values");
    std::map<std::string, double> given;
    for (std::size_t i = 0; i < parameter_count; ++i)
      given[&at(parameters[i], "parameters[]")] = values[i];
    add(scene, name, simulation::SceneMesh::of_shape(&at(type, "type"), given), X_WB);
  });
}

GlissadeStatus glissade_scene_set_movable(GlissadeScene handle, const char* name, int is_movable) {
  return with_scene(handle, [&](simulation::Scene& scene) { named(scene, name).movable = is_movable != 0; });
}

GlissadeStatus glissade_scene_set_pose(GlissadeScene handle, const char* name, const GlissadePose* X_WB) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    simulation::SceneObject& object = named(scene, name);
    if (object.motion) throw std::invalid_argument("'" + object.name + "' moves on its own: its script has its pose");
    object.X_WB = pose_of(at(X_WB, "X_WB"), "X_WB");
  });
}

GlissadeStatus glissade_scene_set_margin(GlissadeScene handle, const char* name, double margin_m) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    base::require_between("margin_m", margin_m, 1e-9, contact::kGreatestMargin_m);
    named(scene, name).margin_m = margin_m;
  });
}

GlissadeStatus glissade_scene_add_hand(GlissadeScene handle, int is_left, double length_m, double breadth_m) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    if (scene.hands.size() == hands::kMaxHands) throw std::invalid_argument("the scene already has four hands");
    grasping::HandShape shape{.side = is_left != 0 ? hands::HandSide::kLeft : hands::HandSide::kRight};
    if (length_m != 0.0) shape.length_m = length_m;
    if (breadth_m != 0.0) shape.breadth_m = breadth_m;
    grasping::make_hand(shape);  // throws now what it would throw later
    scene.hands.push_back(shape);
  });
}

GlissadeStatus glissade_scene_set_friction(GlissadeScene handle, double at_rest, double sliding) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    if (!std::isfinite(at_rest) || !(sliding >= 0.0) || sliding > at_rest)
      throw std::invalid_argument("sliding must be from 0 to at_rest, but at_rest is " + std::to_string(at_rest) +
                                  " and sliding is " + std::to_string(sliding));
    scene.rules.friction = {at_rest, sliding};
  });
}

GlissadeStatus glissade_scene_set_stiffness(GlissadeScene handle, double stiffness_N_per_m) {
  return with_scene(handle, [&](simulation::Scene& scene) {
    base::require_positive("stiffness_N_per_m", stiffness_N_per_m);
    scene.stiffness_N_per_m = stiffness_N_per_m;
  });
}

GlissadeStatus glissade_scene_use_real_time_rules(GlissadeScene handle) {
  return with_scene(handle, [](simulation::Scene& scene) {
    const contact::Friction friction = scene.rules.friction;
    scene.rules = contact::real_time_rules();
    scene.rules.friction = friction;
  });
}

GlissadeStatus glissade_scene_object_count(GlissadeScene handle, size_t* count) {
  return with_scene(handle, [&](const simulation::Scene& scene) { at(count, "count") = scene.objects.size(); });
}

GlissadeStatus glissade_scene_object(GlissadeScene handle, size_t number, GlissadeObject* out) {
  return with_scene(handle, [&](const simulation::Scene& scene) {
    at(out, "out");
    if (number >= scene.objects.size())
      throw std::invalid_argument("there is no object " + std::to_string(number) + ": the scene has " +
                                  std::to_string(scene.objects.size()));
    const simulation::SceneObject& object = scene.objects[number];
    *out = {.name = object.name.c_str(),
            .X_WB = pose_of(object.X_WB),
            .is_movable = object.movable ? 1 : 0,
            .vertices = object.mesh->vertices.data()->data(),
            .vertex_count = object.mesh->vertices.size(),
            .triangles = object.mesh->triangles.data()->data(),
            .triangle_count = object.mesh->triangles.size()};
  });
}
