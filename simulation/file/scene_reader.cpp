#include "file/scene_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/files/did_you_mean.h>
#include <glissade/files/file_checks.h>
#include <glissade/files/pose_files.h>
#include <glissade/files/pose_rules.h>
#include <glissade/files/scene_keys.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/shape_catalog.h>

namespace glissade::simulation {

namespace {

using files::in_quotes;
using files::YamlReader;

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
      if (std::find(known.begin(), known.end(), name) == known.end()) return files::did_you_mean(name, known);
    }
    return "";
  }
  return files::did_you_mean(type, known);
}

/// Reads one scene file.
class SceneReader {
 public:
  SceneReader(std::string source, std::filesystem::path base_folder, KnownMeshes known)
      : yaml_(source), source_(std::move(source)), base_folder_(std::move(base_folder)), known_(std::move(known)) {}

  Scene read(const std::string& text) {
    const YAML::Node root = yaml_.parse(text);
    yaml_.check_keys(root, "scene", files::kSceneKeys);
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
    yaml_.check_keys(node, "object", files::kObjectKeys);
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
    yaml_.fail(node, "compliance_point_m: must lie within " + files::rounded_text(farthest) +
                         " m of the centre of the object's bounding box, not " + files::rounded_text(distance) +
                         " m from it");
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
    const std::vector<geometry::TimedPose> rows = read_timed_poses(node);
    try {
      if (node.IsSequence()) return {geometry::PoseTrajectory(rows), grip};
      return {files::read_trajectory(full_path(yaml_.text(node, "moves"))), grip};
    } catch (const std::invalid_argument& error) {
      yaml_.fail(node, std::string("moves: ") + error.what());
    }
  }

  /// None if the motion is in a file.
  std::vector<geometry::TimedPose> read_timed_poses(const YAML::Node& nodes) const {
    if (!nodes.IsSequence()) return {};
    std::vector<std::string_view> keys{files::kTimeKey};
    keys.insert(keys.end(), files::kPoseKeys.begin(), files::kPoseKeys.end());
    const std::string time_key(files::kTimeKey);
    std::vector<geometry::TimedPose> rows;
    for (const YAML::Node& node : nodes) {
      const Eigen::Isometry3d X_WB = read_pose(node, "moves", keys);
      const double t_s = yaml_.number(yaml_.required(node, "moves", time_key), time_key);
      rows.push_back({files::time_of(t_s, yaml_.where(node) + ": moves", "t_s"), X_WB});
    }
    return rows;
  }

  std::vector<std::int32_t> read_giving_way(const YAML::Node& boxes, const geometry::TriangleMesh& mesh) const {
    if (!boxes.IsSequence()) yaml_.fail(boxes, "gives_way: must be a list of boxes");
    std::set<std::int32_t> triangles;
    for (const YAML::Node& node : boxes) {
      yaml_.check_keys(node, "gives_way", files::kBoxKeys);
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
    if (mesh) return read_mesh(mesh, object["scale"], object["welded"]);
    if (object["welded"]) yaml_.fail(object["welded"], "welded: is for meshes");
    if (object["scale"]) yaml_.fail(object["scale"], "scale: is for meshes; the parameters of a shape are in metres");
    return read_shape(shape);
  }

  SceneMesh read_mesh(const YAML::Node& mesh, const YAML::Node& scale_node, const YAML::Node& welded_node) {
    const std::string path = full_path(yaml_.text(mesh, "mesh"));
    const double scale = scale_node ? yaml_.number(scale_node, "scale") : 1.0;
    if (scale <= 0.0) yaml_.fail(scale_node, "scale: must be positive, not " + in_quotes(scale_node.Scalar()));
    const bool is_welded = !welded_node || yaml_.boolean(welded_node, "welded");
    SceneMesh& file = known_.files[{path, scale, is_welded}];
    if (file.shared()) return file;
    try {
      files::check_input(path);
      return file = SceneMesh(path, scale, is_welded);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(mesh, std::string("mesh: ") + error.what());
    }
  }

  SceneMesh read_shape(const YAML::Node& shape) {
    yaml_.check_map(shape, "shape");
    const std::string type_key(files::kShapeTypeKey);
    const std::string type = yaml_.text(yaml_.required(shape, "shape", type_key), type_key);
    std::map<std::string, double> parameters;
    for (const auto& entry : shape) {
      const std::string& key = entry.first.Scalar();
      if (key != files::kShapeTypeKey) parameters.emplace(key, yaml_.number(entry.second, key));
    }
    SceneMesh& made = known_.shapes[{type, parameters}];
    if (made.shared()) return made;
    try {
      return made = SceneMesh::of_shape(type, parameters);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(shape, std::string("shape: ") + error.what() + meant_shape(type, parameters));
    }
  }

  Eigen::Isometry3d read_pose(const YAML::Node& node, const std::string& key,
                              std::span<const std::string_view> keys = files::kPoseKeys) const {
    yaml_.check_keys(node, key, keys);
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    if (const YAML::Node given = node["position_m"]) position = yaml_.numbers(given, "position_m", 3);
    const YAML::Node wxyz = node["orientation_wxyz"];
    const YAML::Node rpy = node["orientation_rpy_deg"];
    if (const YAML::Node given = node["orientation_matrix"]) {
      if (wxyz || rpy) yaml_.fail(given, key + ": has orientation_matrix and another orientation; give one");
      const Eigen::VectorXd by_rows = yaml_.numbers(given, "orientation_matrix", 9);
      return files::checked_pose(position, Eigen::Matrix3d(by_rows.reshaped<Eigen::RowMajor>(3, 3)),
                                 yaml_.where(given) + ": " + key + ": orientation_matrix");
    }
    if (wxyz && rpy) yaml_.fail(rpy, key + ": has orientation_wxyz and orientation_rpy_deg; give one");
    if (wxyz) {
      const Eigen::Vector4d q = yaml_.numbers(wxyz, "orientation_wxyz", 4);
      return files::checked_pose(position, Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
                                 yaml_.where(wxyz) + ": " + key + ": orientation_wxyz");
    }
    const Eigen::Vector3d angles = rpy ? yaml_.numbers(rpy, "orientation_rpy_deg", 3) : Eigen::Vector3d::Zero();
    return files::checked_pose(position, files::rotation_of(angles[0], angles[1], angles[2]),
                               yaml_.where(node) + ": " + key);
  }

  std::string full_path(const std::string& path) const { return (base_folder_ / path).string(); }

  YamlReader yaml_;
  std::string source_;
  std::filesystem::path base_folder_;
  KnownMeshes known_;
};

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  const std::string name = path.string();
  return parse_scene(files::read_text_file(name, kLargestSceneFile), name, path.parent_path());
}

Scene parse_scene(const std::string& text, const std::string& source, const std::filesystem::path& base_folder) {
  return parse_scene(text, source, base_folder, {});
}

Scene parse_scene(const std::string& text, const std::string& source, const std::filesystem::path& base_folder,
                  KnownMeshes known) {
  return SceneReader(source, base_folder, std::move(known)).read(text);
}

}  // namespace glissade::simulation
