#include "file/target_reader.h"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>
#include <glissade/shapes/shape_catalog.h>

namespace glissade::study {
namespace {

using files::in_quotes;

const std::map<std::string, TargetKind>& global_targets() {
  static const std::map<std::string, TargetKind> targets{{"friction", TargetKind::kFriction},
                                                         {"stiffness_N_per_m", TargetKind::kStiffness},
                                                         {"metaphor", TargetKind::kMetaphor},
                                                         {"trajectory", TargetKind::kTrajectory}};
  return targets;
}

const std::map<std::string, TargetKind>& displaced_targets() {
  static const std::map<std::string, TargetKind> targets{{"path", TargetKind::kPath},
                                                         {"start", TargetKind::kStart},
                                                         {"end", TargetKind::kEnd},
                                                         {"goal", TargetKind::kGoal}};
  return targets;
}

const std::map<std::string, int>& scales() {
  static const std::map<std::string, int> axes{
      {"scale", Target::kAllAxes}, {"scale_x", 0}, {"scale_y", 1}, {"scale_z", 2}};
  return axes;
}

const std::map<std::string, int>& compliances() {
  static const std::map<std::string, int> axes{{"compliance_x_m", 0}, {"compliance_y_m", 1}, {"compliance_z_m", 2}};
  return axes;
}

std::optional<int> axis_from(const std::string& name) {
  const auto found = std::find(kAxisNames.begin(), kAxisNames.end(), name);
  if (found == kAxisNames.end()) return std::nullopt;
  return static_cast<int>(found - kAxisNames.begin());
}

std::vector<std::string> shape_parameters(const simulation::SceneObject& object) {
  std::vector<std::string> names;
  for (const shapes::Shape& shape : shapes::shape_catalog()) {
    if (shape.name != object.mesh.origin().shape) continue;
    for (const shapes::ShapeParameter& parameter : shape.parameters)
      names.push_back(parameter.name);
  }
  return names;
}

[[noreturn]] void fail(const std::string& name, const std::string& wrong, const std::vector<std::string>& known) {
  throw std::invalid_argument(in_quotes(name) + ": there is no " + in_quotes(wrong) +
                              files::did_you_mean(wrong, known) + " (known: " + files::joined(known) + ")");
}

Target target_of_object(const std::string& name, std::size_t object, const std::string& property,
                        const simulation::SceneObject& it, bool is_part) {
  std::vector<std::string> known = shape_parameters(it);
  if (std::find(known.begin(), known.end(), property) != known.end()) {
    return {.kind = TargetKind::kShape, .object = object, .shape_parameter = property};
  }
  if (!it.mesh.origin().file.empty()) known.emplace_back("mesh");
  if (property == "mesh" && !it.mesh.origin().file.empty()) return {.kind = TargetKind::kMesh, .object = object};
  for (const auto& [scale, axis] : scales()) {
    if (property == scale) return {.kind = TargetKind::kScale, .object = object, .axis = axis};
    known.push_back(scale);
  }
  if (is_part) {
    for (const auto& [compliance, axis] : compliances()) {
      if (property == compliance) return {.kind = TargetKind::kCompliance, .object = object, .axis = axis};
      known.push_back(compliance);
    }
  } else if (!it.motion) {
    if (const std::optional<int> axis = axis_from(property)) {
      return {.kind = TargetKind::kPose, .object = object, .axis = *axis};
    }
    known.insert(known.end(), kAxisNames.begin(), kAxisNames.end());
  }
  fail(name, property, known);
}

}  // namespace

Target target_from(const std::string& name, const simulation::Scene& scene, const std::string& part) {
  const auto global = global_targets().find(name);
  if (global != global_targets().end()) return {.kind = global->second};
  const std::size_t dot = name.rfind('.');
  const std::string owner = name.substr(0, dot);
  const std::string property = dot == std::string::npos ? "" : name.substr(dot + 1);
  const auto displaced = displaced_targets().find(owner);
  if (displaced != displaced_targets().end()) {
    const auto has_name = [&](const simulation::SceneObject& object) { return object.name == owner; };
    if (std::any_of(scene.objects.begin(), scene.objects.end(), has_name)) {
      throw std::invalid_argument(in_quotes(name) + ": could mean the " + owner + " of the slide or the object " +
                                  in_quotes(owner) + "; give the object another name");
    }
    if (const std::optional<int> axis = axis_from(property)) return {.kind = displaced->second, .axis = *axis};
    fail(name, property, {kAxisNames.begin(), kAxisNames.end()});
  }
  std::vector<std::string> known;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const simulation::SceneObject& object = scene.objects[i];
    if (object.name == owner && dot != std::string::npos) {
      return target_of_object(name, i, property, object, object.name == part);
    }
    known.push_back(object.name + ".…");
  }
  for (const auto& [displaced_name, kind] : displaced_targets())
    known.push_back(displaced_name + ".…");
  for (const auto& [global_name, kind] : global_targets())
    known.push_back(global_name);
  fail(name, name, known);
}

}  // namespace glissade::study
