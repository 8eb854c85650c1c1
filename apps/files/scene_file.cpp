#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/text.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/files/did_you_mean.h>
#include <glissade/files/file_checks.h>
#include <glissade/files/pose_rules.h>
#include <glissade/files/text_file.h>
#include <glissade/files/trajectory_file.h>
#include <glissade/files/yaml_reader.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/shape_catalog.h>

namespace glissade::apps {

namespace {

using geometry::TriangleMesh;

/// The shape or parameter that was meant, if one of them is unknown.
std::string meant_shape(const std::string& type, const std::map<std::string, double>& parameters) {
  std::vector<std::string> known;
  for (const shapes::Shape& shape : shapes::shape_catalog()) {
    known.push_back(shape.name);
    if (shape.name != type) continue;
    known.clear();
    for (const shapes::ShapeParameter& parameter : shape.parameters)
      known.push_back(parameter.name);
    for (const auto& [name, value] : parameters) {
      if (std::find(known.begin(), known.end(), name) == known.end()) return did_you_mean(name, known);
    }
    return "";
  }
  return did_you_mean(type, known);
}

/// Reads one scene file.
class SceneReader {
 public:
  SceneReader(std::string source, std::filesystem::path base_folder)
      : yaml_(source), source_(std::move(source)), base_folder_(std::move(base_folder)) {}

  Scene read(const std::string& text) {
    const YAML::Node root = yaml_.parse(text);
    yaml_.check_keys(root, "scene", kSceneKeys);
    const YAML::Node objects = yaml_.required(root, "scene", "objects");
    if (!objects.IsSequence() || objects.size() == 0) yaml_.fail(objects, "objects: must be a list of objects");
    Scene scene{.source = source_};
    std::map<std::string, std::string> where_named;
    for (const YAML::Node& object : objects) {
      scene.objects.push_back(read_object(object));
      const auto [entry, is_new] = where_named.emplace(scene.objects.back().name, yaml_.where(object));
      if (!is_new)
        yaml_.fail(object, "name: the object " + in_quotes(entry->first) + " is already at " + entry->second);
    }
    if (root["script"]) scene.script_path = full_path(yaml_.text(root["script"], "script"));
    if (root["goal"]) scene.X_WGoal = read_pose(root["goal"], "goal");
    return scene;
  }

 private:
  SceneObject read_object(const YAML::Node& node) {
    yaml_.check_keys(node, "object", kObjectKeys);
    SceneObject object;
    object.name = yaml_.text(yaml_.required(node, "object", "name"), "name");
    object.mesh = read_geometry(node, object.name);
    if (node["pose"]) object.X_WB = read_pose(node["pose"], "pose");
    if (node["movable"]) object.movable = yaml_.boolean(node["movable"], "movable");
    if (node["moves"]) object.motion = read_motion(node);
    if (object.motion) object.X_WB = object.motion->script_X_WB.pose_at(object.motion->script_X_WB.first_time());
    if (node["grip_N_per_m"] && !object.motion) {
      yaml_.fail(node["grip_N_per_m"], "grip_N_per_m: is for objects that move, see 'moves'");
    }
    if (const YAML::Node margin = node["margin_m"]) {
      object.margin_m = yaml_.number(margin, "margin_m");
      if (!(*object.margin_m > 0.0 && *object.margin_m <= contact::kGreatestMargin_m)) {
        yaml_.fail(margin, "margin_m: must be positive and at most 0.00025, not " + in_quotes(margin.Scalar()));
      }
    }
    if (const YAML::Node point = node["compliance_point_m"]) {
      object.compliance_point_B = read_compliance_point(point, *object.mesh);
    }
    if (node["gives_way"]) object.giving_way = read_giving_way(node["gives_way"], *object.mesh);
    return object;
  }

  /// The limit is that of `contact::SlidingPart`, but the message names key and line.
  Eigen::Vector3d read_compliance_point(const YAML::Node& node, const geometry::TriangleMesh& mesh) const {
    const Eigen::Vector3d point = yaml_.numbers(node, "compliance_point_m", 3);
    const Eigen::Vector3d center = geometry::bounds_of(mesh).center();
    double radius = 0.0;
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      radius = std::max(radius, (vertex - center).norm());
    const double farthest = contact::kFarthestPoint * radius;
    const double distance = (point - center).norm();
    if (distance <= farthest) return point;
    yaml_.fail(node, "compliance_point_m: must lie within " + rounded_text(farthest) +
                         " m of the centre of the object's bounding box, not " + rounded_text(distance) + " m from it");
  }

  SceneMotion read_motion(const YAML::Node& object) const {
    for (const char* key : {"pose", "movable", "margin_m"}) {
      if (object[key]) yaml_.fail(object[key], std::string(key) + ": is not for objects that move, see 'moves'");
    }
    const YAML::Node node = object["moves"];
    std::optional<double> grip;
    if (const YAML::Node given = object["grip_N_per_m"]) {
      grip = yaml_.number(given, "grip_N_per_m");
      if (!(*grip > 0.0)) yaml_.fail(given, "grip_N_per_m: must be positive, not " + in_quotes(given.Scalar()));
    }
    try {
      return {read_trajectory(full_path(yaml_.text(node, "moves"))), grip};
    } catch (const std::invalid_argument& error) {
      yaml_.fail(node, std::string("moves: ") + error.what());
    }
  }

  std::vector<std::int32_t> read_giving_way(const YAML::Node& boxes, const geometry::TriangleMesh& mesh) const {
    if (!boxes.IsSequence()) yaml_.fail(boxes, "gives_way: must be a list of boxes");
    std::set<std::int32_t> triangles;
    for (const YAML::Node& node : boxes) {
      yaml_.check_keys(node, "gives_way", kBoxKeys);
      const Eigen::AlignedBox3d box(
          Eigen::Vector3d(yaml_.numbers(yaml_.required(node, "gives_way", "min_m"), "min_m", 3)),
          Eigen::Vector3d(yaml_.numbers(yaml_.required(node, "gives_way", "max_m"), "max_m", 3)));
      if (box.isEmpty()) yaml_.fail(node, "gives_way: min_m must not be above max_m");
      const std::vector<std::int32_t> inside = geometry::triangles_inside(mesh, box);
      if (inside.empty()) yaml_.fail(node, "gives_way: no triangle of the object lies inside this box");
      triangles.insert(inside.begin(), inside.end());
    }
    return {triangles.begin(), triangles.end()};
  }

  SceneMesh read_geometry(const YAML::Node& object, const std::string& name) {
    const YAML::Node mesh = object["mesh"];
    const YAML::Node shape = object["shape"];
    if (mesh && shape) yaml_.fail(shape, "object " + in_quotes(name) + " has both a mesh and a shape");
    if (!mesh && !shape) yaml_.fail(object, "object " + in_quotes(name) + " has neither a mesh nor a shape");
    if (mesh) return read_mesh(mesh, object["scale"]);
    if (object["scale"]) yaml_.fail(object["scale"], "scale: is for meshes; the parameters of a shape are in metres");
    return read_shape(shape);
  }

  SceneMesh read_mesh(const YAML::Node& mesh, const YAML::Node& scale_node) {
    const std::string path = full_path(yaml_.text(mesh, "mesh"));
    const double scale = scale_node ? yaml_.number(scale_node, "scale") : 1.0;
    if (scale <= 0.0) yaml_.fail(scale_node, "scale: must be positive, not " + in_quotes(scale_node.Scalar()));
    SceneMesh& file = files_[{path, scale}];
    if (file.shared()) return file;
    try {
      check_input(path);
      return file = SceneMesh(path, scale);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(mesh, std::string("mesh: ") + error.what());
    }
  }

  SceneMesh read_shape(const YAML::Node& shape) {
    yaml_.check_map(shape, "shape");
    const std::string type_key(kShapeTypeKey);
    const std::string type = yaml_.text(yaml_.required(shape, "shape", type_key), type_key);
    std::map<std::string, double> parameters;
    for (const auto& entry : shape) {
      const std::string& key = entry.first.Scalar();
      if (key != kShapeTypeKey) parameters.emplace(key, yaml_.number(entry.second, key));
    }
    SceneMesh& made = shapes_[{type, parameters}];
    if (made.shared()) return made;
    try {
      return made = shapes::make_shape(type, parameters);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(shape, std::string("shape: ") + error.what() + meant_shape(type, parameters));
    }
  }

  Eigen::Isometry3d read_pose(const YAML::Node& node, const std::string& key) const {
    yaml_.check_keys(node, key, kPoseKeys);
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    if (const YAML::Node given = node["position_m"]) position = yaml_.numbers(given, "position_m", 3);
    std::string where = yaml_.where(node) + ": " + key;
    if (const YAML::Node given = node["orientation_wxyz"]) {
      const Eigen::Vector4d wxyz = yaml_.numbers(given, "orientation_wxyz", 4);
      q = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
      where = yaml_.where(given) + ": " + key + ": orientation_wxyz";
    }
    if (const YAML::Node given = node["orientation_rpy_deg"]) {
      if (node["orientation_wxyz"]) yaml_.fail(given, key + ": has orientation_wxyz and orientation_rpy_deg; give one");
      const Eigen::Vector3d rpy = yaml_.numbers(given, "orientation_rpy_deg", 3);
      q = rotation_of(rpy[0], rpy[1], rpy[2]);
    }
    return checked_pose(position, q, where);
  }

  std::string full_path(const std::string& path) const { return (base_folder_ / path).string(); }

  YamlReader yaml_;
  std::string source_;
  std::filesystem::path base_folder_;
  std::map<std::pair<std::string, double>, SceneMesh> files_;                          // by path and scale
  std::map<std::pair<std::string, std::map<std::string, double>>, SceneMesh> shapes_;  // by type and parameters
};

}  // namespace

const SceneObject& find_object(const Scene& scene, const std::string& name) {
  std::vector<std::string> known;
  for (const SceneObject& object : scene.objects) {
    if (object.name == name) return object;
    known.push_back(object.name);
  }
  throw std::invalid_argument(scene.source + ": there is no object " + in_quotes(name) + did_you_mean(name, known) +
                              " (known: " + joined(known) + ")");
}

Scene read_scene(const std::string& path) {
  constexpr std::uintmax_t kLargestScene = std::uintmax_t{1} << 26U;
  return parse_scene(read_text_file(path, kLargestScene), path, std::filesystem::path(path).parent_path().string());
}

Scene parse_scene(const std::string& text, const std::string& source, const std::string& base_folder) {
  return SceneReader(source, base_folder).read(text);
}

}  // namespace glissade::apps
