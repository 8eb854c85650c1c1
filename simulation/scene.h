#pragma once

/// A scene before anything moves. It has objects, hands and the rules of contact. Hands can hold some objects; scripts
/// move others.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/metaphor.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::simulation {

/// A mesh in metres: a value, a shared one, that of a file, or a shape of the catalogue. Copies share it.
class SceneMesh {
 public:
  SceneMesh() = default;
  SceneMesh(geometry::TriangleMesh mesh) : SceneMesh(std::make_shared<const geometry::TriangleMesh>(std::move(mesh))) {}
  SceneMesh(std::shared_ptr<const geometry::TriangleMesh> mesh) : mesh_(std::move(mesh)) {}
  /// Reads OBJ, STL, PLY or glTF whose unit is `scale` metres, e.g. 1e-3 for millimetres, as `geometry::import_mesh`
  /// does, or `geometry::import_unwelded_mesh`. Throws std::invalid_argument, naming the file, as they do.
  SceneMesh(const std::filesystem::path& file, double scale, bool is_welded = true);
  /// Makes a shape of the catalogue in docs/scene_files.md; parameters that are not given take their defaults. Throws
  /// std::invalid_argument, listing the known names, for an unknown shape or parameter, and for a value out of range.
  static SceneMesh of_shape(const std::string& type, const std::map<std::string, double>& parameters = {});

  const geometry::TriangleMesh& operator*() const { return *mesh_; }
  const geometry::TriangleMesh* operator->() const { return mesh_.get(); }
  /// Null if no mesh was given.
  const std::shared_ptr<const geometry::TriangleMesh>& shared() const { return mesh_; }

  /// How a scene file tells of the mesh. Both names are empty for a mesh given as a value.
  struct Origin {
    std::filesystem::path file{};  ///< absolute
    double scale = 1.0;            ///< metres per unit of the file
    bool is_welded = true;
    std::string shape{};  ///< type in the catalogue
    std::map<std::string, double> parameters{};
  };
  const Origin& origin() const { return origin_; }

  // Of a mesh from a file:
  /// Triangles without area, which were left out.
  std::int64_t degenerate_triangles() const { return degenerate_triangles_; }
  /// The warnings of `geometry::import_mesh`. Each begins with the name of the file.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  Origin origin_{};
  std::int64_t degenerate_triangles_ = 0;
  std::vector<std::string> warnings_{};
};

/// Motion of an object that moves on its own, or in another hand.
struct SceneMotion {
  geometry::PoseTrajectory script_X_WB;
  std::optional<double> grip_N_per_m{};  ///< default: that of `contact::ScriptedPart`
};

/// One object at its initial pose.
struct SceneObject {
  std::string name;
  SceneMesh mesh;  ///< in the object's frame B
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  bool movable = false;                 ///< hands can hold it
  std::optional<SceneMotion> motion{};  ///< of an object that is not movable; it starts where the script does
  std::optional<double> margin_m{};     ///< `contact::Obstacle::margin`; without effect on what moves
  /// Where the spring of the coupling acts; default: the centre of the bounding box.
  std::optional<Eigen::Vector3d> compliance_point_B{};
  std::vector<std::int32_t> giving_way{};  ///< triangles that stop nothing, ascending
};

/// Objects, all of different names; hands with fingers; and how parts are held and touch.
struct Scene {
  std::vector<SceneObject> objects{};
  std::vector<grasping::HandShape> hands{};
  contact::Metaphor metaphor = contact::Metaphor::kForceFeedback;
  /// Of the coupling against translation; against rotation, this times the square of the part's radius.
  double stiffness_N_per_m = contact::kUsualStiffness_N_per_m;
  contact::SlidingRules rules{};
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();  ///< of unit length, against gravity, for grasps
  std::string source = "the scene";                 ///< such as the file's name, for messages
  std::optional<Eigen::Isometry3d> X_WGoal{};       ///< of the first part, for checks
  std::optional<std::string> script_path{};         ///< of the trajectory that belongs to a scene file

  /// Throws std::invalid_argument, with the known names and the one that may have been meant, when there is no object
  /// `name`.
  const SceneObject& find(const std::string& name) const;
  /// The names of the movable objects, in their order.
  std::vector<std::string> movable_names() const;
};

/// Reads a scene file, and the meshes and motions that it names; docs/scene_files.md has every key. Objects of one mesh
/// share it; `script_path` is only noted. Throws std::invalid_argument, one line with file, line and key or value, for
/// every deviation from the format. May block on the disk. Thread-safe. Cost: that of its meshes.
Scene read_scene(const std::filesystem::path& path);

/// The same for a text in memory: `source` replaces the file's name in messages, and paths in the scene are relative to
/// `base_folder`.
Scene parse_scene(const std::string& text, const std::string& source, const std::filesystem::path& base_folder);

/// Writes a scene file that `read_scene` reads back as an equal scene, with every number to the bit. In the file are
/// all objects, their poses as matrices, motions row by row, and shapes by their parameters. Meshes of files and the
/// script stay where they are: the file has their paths, relative to its folder. Each mesh given as a value is written
/// beside the file, as STEM_N.obj for object N (the first is 1), once for all objects that share it.
///
/// A file that is there already is kept if it has the same content; if one has another, nothing is written.
///
/// Throws std::invalid_argument, naming the file or the object: for such a file, and a folder that is not there; for
/// what scene files do not have (hands, and rules, metaphor, stiffness or upward direction that are not the default);
/// for what `bodies_of` refuses of any object; and for what the reader refuses or would change: names that are empty or
/// no UTF-8, rotations with a `geometry::rotation_defect` above 1e-12, times that no number of seconds gives to the
/// nanosecond (beyond some 26 days), triangles that give way where no axis-aligned box holds them and no others, and
/// values out of range.
/// Throws std::runtime_error when not everything could be written, such as on a full disk. May block on the disk.
/// Thread-safe, but for calls that write the same file. Cost: linear in the size of its meshes; for triangles that give
/// way, in those of their object for each box.
void write_scene(const Scene& scene, const std::filesystem::path& path);

/// A part that hands can hold.
struct ScenePart {
  std::string name;
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
};

/// The objects of a scene, prepared for contact: obstacles of one mesh share their body. Bodies are numbered as in
/// contacts: obstacles, parts, objects that move on their own.
struct SceneBodies {
  std::string source;            ///< `Scene::source`
  std::vector<ScenePart> parts;  ///< at least one
  std::vector<contact::Obstacle> obstacles;
  std::vector<contact::ScriptedPart> moving;  ///< the objects that move on their own
  std::vector<std::string> body_names;        ///< by the number of the body
  std::optional<Eigen::Isometry3d> X_WGoal;   ///< of the first part

  /// Number of the part with this name; nothing if there is none.
  std::optional<std::size_t> part_number(const std::string& name) const;
  /// The names of all parts, in quotes, for messages.
  std::string part_names() const;
};

/// Takes the objects with these names as the parts, in this order; other movable ones are obstacles. Throws
/// std::invalid_argument, naming the scene and the object, when there is no such object or no other one, when an object
/// at its pose has no area or reaches beyond ±1e9 m, when a part moves on its own or is named twice, when two objects
/// have one name, when triangles that give way are not ascending numbers of the mesh, and for more than
/// `contact::kMaxParts` parts and objects that move on their own. Cost: the trees of the meshes.
SceneBodies bodies_of(const Scene& scene, const std::vector<std::string>& part_names);

/// All parts of a simulation: those that hands can hold, then the objects that move on their own. The stiffness is as
/// in `Scene`.
std::vector<contact::HeldPart> held_parts(const SceneBodies& bodies, contact::Metaphor metaphor,
                                          double stiffness_N_per_m);

/// The models of hands. Hands of one shape share theirs.
std::vector<std::shared_ptr<const grasping::HandModel>> hand_models(std::span<const grasping::HandShape> hands);

/// The triangles of an object that stop something.
std::shared_ptr<const geometry::TriangleMesh> stopping_mesh(const SceneObject& object);

}  // namespace glissade::simulation
