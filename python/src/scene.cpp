#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/simulation/scene.h>

#include "arrays.h"
#include "mesh_files.h"
#include "module.h"
#include "unlocked.h"

namespace glissade::python {

namespace {

using contact::SlidingRules;
using simulation::Scene;
using simulation::SceneMesh;
using simulation::SceneMotion;
using simulation::SceneObject;

geometry::PoseTrajectory motion_from(const py::object& motion) {
  if (!py::isinstance<py::sequence>(motion) || py::len(motion) != 2)
    throw py::type_error("motion must be the times and the poses");
  return trajectory_from(motion[py::int_(0)], "motion[0]", motion[py::int_(1)], "motion[1]");
}

void add_object(Scene& scene, const std::string& name, const SceneMesh& mesh, const py::object& X_WB, bool is_movable,
                const py::object& motion, std::optional<double> margin_m, const py::object& compliance_point_B,
                std::vector<std::int32_t> giving_way) {
  SceneObject object{
      .name = name, .mesh = mesh, .movable = is_movable, .margin_m = margin_m, .giving_way = std::move(giving_way)};
  if (!X_WB.is_none()) object.X_WB = pose_from(X_WB, "X_WB");
  if (!motion.is_none()) {
    if (!X_WB.is_none() || is_movable)
      throw std::invalid_argument("an object with a motion begins at its first pose and is not movable");
    object.motion = SceneMotion{motion_from(motion)};
    object.X_WB = object.motion->script_X_WB.rows().front().X_WB;
  }
  if (!compliance_point_B.is_none()) object.compliance_point_B = vector_from(compliance_point_B, "compliance_point_B");
  scene.objects.push_back(std::move(object));
}

/// The scene that read() returns. Its meshes warn of what was skipped in their files.
template <typename Read>
Scene read_with(const Read& read) {
  Scene scene = [&] {
    const Unlocked unlocked;
    return read();
  }();
  for (const SceneObject& object : scene.objects)
    warn_of(object.mesh);
  return scene;
}

Scene read(const py::object& path) {
  return read_with([file = path_from(path)] { return simulation::read_scene(file); });
}

Scene parse(const std::string& text, const std::string& source, const py::object& base_folder) {
  return read_with([&, folder = path_from(base_folder)] { return simulation::parse_scene(text, source, folder); });
}

/// Of a copy of the scene: other threads may change the scene meanwhile.
void write(Scene scene, const py::object& path) {
  const std::string file = path_from(path);
  const Unlocked unlocked;
  simulation::write_scene(scene, file);
}

contact::Metaphor metaphor_from(const std::string& name) {
  const std::optional<contact::Metaphor> metaphor = contact::metaphor_from_name(name);
  if (metaphor) return *metaphor;
  std::string known;
  for (const std::string_view each : contact::kMetaphorNames)
    known += (known.empty() ? "'" : "', '") + std::string(each);
  throw std::invalid_argument("metaphor must be one of " + known + "', not '" + name + "'");
}

void set_overlap(SlidingRules& rules, const std::string& name) {
  if (name != "refuse" && name != "depenetrate")
    throw std::invalid_argument("overlap must be 'refuse' or 'depenetrate', not '" + name + "'");
  rules.overlap = name == "refuse" ? contact::OverlapRule::kRefuse : contact::OverlapRule::kDepenetrate;
}

void add_rules(py::module_& module) {
  py::class_<SlidingRules>(module, "SlidingRules", "The rules of contact for all parts of a scene.")
      .def(py::init<>(), "Makes the rules of a simulation that takes the time that it needs.")
      .def_static("real_time", &contact::real_time_rules,
                  "Rules for a simulation in real time: few cycles, a search thread and short searches.")
      .def_readwrite("max_cycles", &SlidingRules::max_cycles, "most cycles of a call, at least 1")
      .def_readwrite(
          "margin_m", &SlidingRules::margin,
          "the gap at which contacts stop a part, metres; None: 1e-4 of the part's radius, 2 to 10 micrometres")
      .def_property(
          "friction",
          [](const SlidingRules& rules) { return std::pair(rules.friction.at_rest, rules.friction.sliding); },
          [](SlidingRules& rules, const std::pair<double, double>& friction) {
            rules.friction = {friction.first, friction.second};
          },
          "coefficients of Coulomb friction at rest and while sliding; (0, 0): none")
      .def_property(
          "overlap",
          [](const SlidingRules& rules) {
            return rules.overlap == contact::OverlapRule::kRefuse ? "refuse" : "depenetrate";
          },
          &set_overlap, "'refuse' or 'depenetrate' parts that overlap an obstacle at the start")
      .def_readwrite("spiral_search", &SlidingRules::spiral_search, "search for a hole as a hand with a peg does")
      .def_readwrite("has_search_thread", &SlidingRules::has_search_thread, "search in advance, in a thread of its own")
      .def_readwrite("contacts_ahead_ms", &SlidingRules::contacts_ahead_ms,
                     "also find the contacts that the ghost may reach within this time")
      .def_readwrite("affordable_pairs", &SlidingRules::affordable_pairs,
                     "pairs of triangles that a search may find, at least 1; with more, steps become shorter")
      .def_readwrite("work_budget", &SlidingRules::work_budget,
                     "most work of a call, about nanoseconds; None: no limit");
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects)
    names.push_back(object.name);
  return names;
}

}  // namespace

void add_scene(py::module_& module) {
  add_rules(module);
  py::class_<Scene>(module, "Scene", "Objects with names, hands, and the rules of contact, before anything moves.")
      .def(py::init<>(), "Makes a scene without objects and hands.")
      .def_static("read", &read, py::arg("path"),
                  "Reads a scene file with its meshes. Raises ValueError with file, line and key.")
      .def_static("parse", &parse, py::arg("text"), py::arg("source") = "the scene", py::arg("base_folder") = ".",
                  "Like `read`, for a text. Paths in the scene are relative to `base_folder`.")
      .def("write", &write, py::arg("path"),
           "Writes a scene file, and files of the meshes that were given as arrays. Overwrites nothing that differs.")
      .def("add", &add_object, py::arg("name"), py::arg("mesh"), py::arg("X_WB") = py::none(), py::kw_only(),
           py::arg("movable") = false, py::arg("motion") = py::none(), py::arg("margin_m") = py::none(),
           py::arg("compliance_point_B") = py::none(), py::arg("giving_way") = std::vector<std::int32_t>{},
           R"(Adds an object.

X_WB: its pose, (7,) or (4, 4); None: the origin. movable: hands can hold it, so it is a part. motion: times (n,) in
seconds and poses (n, 7) or (n, 4, 4) of an object that moves on its own. margin_m: the gap at which this object stops
parts, metres. compliance_point_B: where the coupling acts, (3,) metres; None: the centre. giving_way: numbers of triangles
that stop nothing, ascending.)")
      .def_property_readonly("names", &names_of, "the names of all objects")
      .def_property_readonly("movable_names", &Scene::movable_names, "the names of the parts, in their order")
      .def_readwrite("hands", &Scene::hands, "list of HandShape, a copy")
      .def_readwrite("rules", &Scene::rules, "the SlidingRules of all parts")
      .def_property(
          "metaphor", [](const Scene& scene) { return std::string(contact::name_of(scene.metaphor)); },
          [](Scene& scene, const std::string& name) { scene.metaphor = metaphor_from(name); },
          "how the hand moves the part: 'force-feedback', 'rubber-band', 'rubber-band-spring' or 'incremental'")
      .def_readwrite("stiffness_N_per_m", &Scene::stiffness_N_per_m, "of the coupling between hand and part")
      .def_property(
          "up_W", [](const Scene& scene) { return to_array(scene.up_W); },
          [](Scene& scene, const py::object& up_W) { scene.up_W = vector_from(up_W, "up_W"); },
          "(3,) unit vector against gravity")
      .def_property_readonly(
          "X_WGoal",
          [](const Scene& scene) { return scene.X_WGoal ? py::object(to_array(*scene.X_WGoal)) : py::none(); },
          "(4, 4) goal pose of the first part, or None");
}

}  // namespace glissade::python
