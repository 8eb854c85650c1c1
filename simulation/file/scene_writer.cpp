#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include <yaml-cpp/yaml.h>

#include <glissade/files/obj_text.h>
#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>

#include "bodies/scene_bodies.h"
#include "file/scene_reader.h"

namespace glissade::simulation {
namespace {

using Triangles = std::vector<std::int32_t>;

bool are_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(a.matrix())) == 0;
}

void add_text(YAML::Emitter& out, const std::string& key, const std::string& text) {
  out << YAML::Key << key << YAML::Value << text;
}

void add_number(YAML::Emitter& out, const std::string& key, double number) {
  add_text(out, key, files::exact_number(number));
}

void add_numbers(YAML::Emitter& out, const std::string& key, const Eigen::VectorXd& numbers) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double number : numbers)
    out << files::exact_number(number);
  out << YAML::EndSeq;
}

/// The keys of a pose.
void add_pose(YAML::Emitter& out, const Eigen::Isometry3d& X) {
  add_numbers(out, "position_m", X.translation());
  if (!are_same(Eigen::Isometry3d(X.linear()), Eigen::Isometry3d::Identity()))
    add_numbers(out, "orientation_matrix", X.linear().reshaped<Eigen::RowMajor>());
}

void add_pose(YAML::Emitter& out, const std::string& key, const Eigen::Isometry3d& X) {
  out << YAML::Key << key << YAML::Value << YAML::BeginMap;
  add_pose(out, X);
  out << YAML::EndMap;
}

/// One box that holds `some` of the triangles that give way. Halves of them, each with its boxes, where the box holds
/// others, too.
void add_boxes(YAML::Emitter& out, const SceneObject& object, Triangles some) {
  Eigen::AlignedBox3d box;
  for (const std::int32_t triangle : some) {
    for (const Eigen::Vector3d& corner : object.mesh->corners(triangle))
      box.extend(corner);
  }
  const Triangles inside = geometry::triangles_inside(*object.mesh, box);
  const Triangles& all = object.giving_way;
  if (some.size() == 1 || std::includes(all.begin(), all.end(), inside.begin(), inside.end())) {
    out << YAML::Flow << YAML::BeginMap;
    add_numbers(out, "min_m", box.min());
    add_numbers(out, "max_m", box.max());
    out << YAML::EndMap;
    return;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::sort(some.begin(), some.end(), [&](std::int32_t a, std::int32_t b) {
    return object.mesh->corner(a, 0)[axis] < object.mesh->corner(b, 0)[axis];
  });
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  add_boxes(out, object, {some.begin(), middle});
  add_boxes(out, object, {middle, some.end()});
}

void add_motion(YAML::Emitter& out, const SceneMotion& motion) {
  out << YAML::Key << "moves" << YAML::Value << YAML::BeginSeq;
  for (const geometry::TimedPose& row : motion.script_X_WB.rows()) {
    out << YAML::Flow << YAML::BeginMap;
    add_number(out, "t_s", std::chrono::duration<double>(row.time).count());
    add_pose(out, row.X_WB);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
  if (motion.grip_N_per_m) add_number(out, "grip_N_per_m", *motion.grip_N_per_m);
}

/// What of an object its file cannot tell; empty if nothing.
std::string what_is_lost(const SceneObject& object, const SceneObject& read) {
  if (read.name != object.name) return "its name is no text in UTF-8";
  if (read.giving_way != object.giving_way) return "no boxes hold the triangles that give way, and no others";
  if (!object.motion) return are_same(object.X_WB, read.X_WB) ? "" : "its rotation has a defect above 1e-12";
  for (std::size_t i = 0; i < object.motion->script_X_WB.rows().size(); ++i) {
    const geometry::TimedPose& row = object.motion->script_X_WB.rows()[i];
    const geometry::TimedPose& read_row = read.motion->script_X_WB.rows()[i];
    if (row.time != read_row.time || !are_same(row.X_WB, read_row.X_WB))
      return "row " + std::to_string(i) + " of its motion has " +
             (row.time != read_row.time ? "a time that no number of seconds gives to the nanosecond"
                                        : "a rotation with a defect above 1e-12");
  }
  return "";
}

/// Makes the files of one scene.
class SceneWriter {
 public:
  explicit SceneWriter(std::filesystem::path path) : path_(std::move(path)), folder_(path_.parent_path()) {
    if (folder_.empty()) folder_ = ".";
  }

  /// The scene, after the meshes that it names.
  std::vector<files::TextFile> files_of(const Scene& scene) {
    check_kind(scene);
    std::string text = "objects:\n";
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      text += entry_of(scene.objects[i], i + 1) + '\n';
    YAML::Emitter out;
    out << YAML::BeginMap;
    if (scene.script_path) add_text(out, "script", from_folder(*scene.script_path));
    if (scene.X_WGoal) add_pose(out, "goal", *scene.X_WGoal);
    out << YAML::EndMap;
    if (scene.script_path && YAML::Load(out.c_str())["script"].Scalar() != from_folder(*scene.script_path))
      fail("the name of its script is no text in UTF-8");
    if (scene.script_path || scene.X_WGoal) text += out.c_str() + std::string("\n");
    if (text.size() > kLargestSceneFile) fail("it would have more than 64 MiB");
    files_.push_back({path_.string(), std::move(text)});
    return std::move(files_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::invalid_argument(path_.string() + ": cannot be written: " + reason);
  }

  void check_kind(const Scene& scene) const {
    check_scene(scene);
    const Scene usual;
    if (scene.objects.empty()) fail("there are no objects");
    if (!scene.hands.empty()) fail("scene files have no hands");
    if (scene.metaphor != usual.metaphor || scene.stiffness_N_per_m != usual.stiffness_N_per_m ||
        scene.rules != usual.rules || scene.up_W != usual.up_W)
      fail("scene files have no metaphor, stiffness, rules or upward direction but the default");
    if (!scene.X_WGoal) return;
    const Eigen::Isometry3d& X = *scene.X_WGoal;
    if (!are_same(X, files::checked_pose(X.translation(), Eigen::Matrix3d(X.linear()), path_.string() + ": goal")))
      fail("goal: its rotation has a defect above 1e-12");
  }

  /// The object as an element of the list.
  std::string entry_of(const SceneObject& object, std::size_t number) {
    YAML::Emitter out;
    out << YAML::BeginSeq << YAML::BeginMap;
    add_text(out, "name", object.name);
    KnownMeshes known;
    add_mesh(out, object.mesh, number, known);
    if (object.motion) add_motion(out, *object.motion);
    if (!object.motion) add_pose(out, "pose", object.X_WB);
    if (object.movable) add_text(out, "movable", "true");
    if (object.margin_m) add_number(out, "margin_m", *object.margin_m);
    if (object.compliance_point_B) add_numbers(out, "compliance_point_m", *object.compliance_point_B);
    if (!object.giving_way.empty()) {
      out << YAML::Key << "gives_way" << YAML::Value << YAML::BeginSeq;
      add_boxes(out, object, object.giving_way);
      out << YAML::EndSeq;
    }
    out << YAML::EndMap << YAML::EndSeq;
    check_entry(object, out.c_str(), std::move(known));
    return out.c_str();
  }

  /// Reads the entry back: the reader has the rules.
  void check_entry(const SceneObject& object, const std::string& entry, KnownMeshes known) const {
    const std::string named = "object " + files::in_quotes(object.name) + ": ";
    std::string reason;
    try {
      const Scene read = parse_scene("objects:\n" + entry, "its entry", folder_, std::move(known));
      reason = what_is_lost(object, read.objects.front());
    } catch (const std::invalid_argument& error) {
      reason = error.what();
    }
    if (!reason.empty()) fail(named + reason);
  }

  void add_mesh(YAML::Emitter& out, const SceneMesh& mesh, std::size_t number, KnownMeshes& known) {
    const SceneMesh::Origin& origin = mesh.origin();
    if (!origin.shape.empty()) {
      known.shapes[{origin.shape, origin.parameters}] = mesh;
      out << YAML::Key << "shape" << YAML::Value << YAML::Flow << YAML::BeginMap;
      add_text(out, "type", origin.shape);
      for (const auto& [name, value] : origin.parameters)
        add_number(out, name, value);
      out << YAML::EndMap;
      return;
    }
    const bool is_own = origin.file.empty();
    const std::string file = is_own ? own_file(mesh, number) : from_folder(origin.file);
    const bool is_welded = origin.is_welded && !is_own;
    known.files[{(folder_ / file).string(), origin.scale, is_welded}] = mesh;
    add_text(out, "mesh", file);
    if (origin.scale != 1.0) add_number(out, "scale", origin.scale);
    if (!is_welded) add_text(out, "welded", "false");
  }

  /// The file for a mesh that was given as a value.
  std::string own_file(const SceneMesh& mesh, std::size_t number) {
    std::string& name = own_files_[mesh.shared().get()];
    if (!name.empty()) return name;
    name = path_.stem().string() + "_" + std::to_string(number) + ".obj";
    files_.push_back({(folder_ / name).string(), {}});
    files::append_obj(files_.back().text, *mesh);
    return name;
  }

  std::string from_folder(const std::filesystem::path& file) const {
    return std::filesystem::proximate(file, folder_).string();
  }

  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::map<const geometry::TriangleMesh*, std::string> own_files_;
  std::vector<files::TextFile> files_;
};

}  // namespace

void write_scene(const Scene& scene, const std::filesystem::path& path) {
  files::write_new_files(SceneWriter(path).files_of(scene));
}

}  // namespace glissade::simulation
