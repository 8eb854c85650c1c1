#pragma once

/// A scene before anything moves. A scene has objects, hands and the rules of contact. Hands can hold some objects.
/// Scripts move other objects.

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

#include <glissade/base/export.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::simulation {

/// A mesh in metres: a given mesh, the mesh of a file, or a shape of the catalogue. Copies of a `SceneMesh` share the
/// mesh.
class GLISSADE_EXPORT SceneMesh {
 public:
  SceneMesh() = default;
  SceneMesh(geometry::TriangleMesh mesh) : SceneMesh(std::make_shared<const geometry::TriangleMesh>(std::move(mesh))) {}
  SceneMesh(std::shared_ptr<const geometry::TriangleMesh> mesh) : mesh_(std::move(mesh)) {}
  /// Reads a mesh file (OBJ, STL, PLY, glTF) whose unit is `scale` metres, e.g. 1e-3 for millimetres. If `is_welded`,
  /// `geometry::import_mesh` reads the file, otherwise `geometry::import_unwelded_mesh`. Throws std::invalid_argument,
  /// naming the file, as these functions do.
  SceneMesh(const std::filesystem::path& file, double scale, bool is_welded = true);
  /// Makes a shape of the catalogue in docs/scene_files.md. Parameters that are not given have their defaults. Throws
  /// std::invalid_argument for an unknown shape or parameter (the message lists the known names) and for a value out of
  /// range.
  static SceneMesh of_shape(const std::string& type, const std::map<std::string, double>& parameters = {});

  const geometry::TriangleMesh& operator*() const { return *mesh_; }
  const geometry::TriangleMesh* operator->() const { return mesh_.get(); }
  /// Null if no mesh was given.
  const std::shared_ptr<const geometry::TriangleMesh>& shared() const { return mesh_; }

  /// The source of the mesh, as a scene file names it. `file` and `shape` are empty for a mesh given as a value.
  struct Origin {
    std::filesystem::path file{};  ///< absolute
    double scale = 1.0;            ///< metres per unit of the file
    bool is_welded = true;
    std::string shape{};  ///< type in the catalogue
    std::map<std::string, double> parameters{};
  };
  const Origin& origin() const { return origin_; }

  // Of a mesh from a file:
  /// Number of triangles without area. These triangles were left out.
  std::int64_t degenerate_triangles() const { return degenerate_triangles_; }
  /// The warnings of `geometry::import_mesh`. Each warning begins with the name of the file.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  Origin origin_{};
  std::int64_t degenerate_triangles_ = 0;
  std::vector<std::string> warnings_{};
};

/// Motion of an object that moves on its own or in another hand.
struct SceneMotion {
  geometry::PoseTrajectory script_X_WB;
  std::optional<double> grip_N_per_m{};  ///< default: as in `contact::ScriptedPart`
};

/// One object at its initial pose.
struct SceneObject {
  std::string name;
  SceneMesh mesh;  ///< in the object's frame B
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  bool movable = false;                 ///< hands can hold it
  std::optional<SceneMotion> motion{};  ///< only if not `movable`; its script gives the initial pose
  std::optional<double> margin_m{};     ///< see `contact::Obstacle::margin`; no effect on moving objects
  /// The point at which the coupling spring acts. Default: the centre of the bounding box.
  std::optional<Eigen::Vector3d> compliance_point_B{};
  std::vector<std::int32_t> giving_way{};  ///< numbers of triangles that stop nothing, ascending
};

/// Objects with different names, hands with fingers, and the rules for holding and contact.
struct GLISSADE_EXPORT Scene {
  std::vector<SceneObject> objects{};
  std::vector<grasping::HandShape> hands{};
  contact::Metaphor metaphor = contact::Metaphor::kForceFeedback;
  /// Stiffness of the coupling against translation. The stiffness against rotation is this stiffness times the square
  /// of the part's radius.
  double stiffness_N_per_m = contact::kUsualStiffness_N_per_m;
  contact::SlidingRules rules{};
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();  ///< unit vector against gravity, for grasps
  std::string source = "the scene";                 ///< for messages, such as the name of the file
  std::optional<Eigen::Isometry3d> X_WGoal{};       ///< goal pose of the first part, for checks
  std::optional<std::string> script_path{};         ///< path of the trajectory of a scene file

  /// Throws std::invalid_argument if there is no object `name`. The message lists the known names, and the name that
  /// may have been meant.
  const SceneObject& find(const std::string& name) const;
  /// The names of the movable objects, in the order of `objects`.
  std::vector<std::string> movable_names() const;
};

/// Reads a scene file, and the meshes and motions that the file names. For all keys, see docs/scene_files.md. Objects
/// with the same mesh share one copy. The file at `script_path` is not read. Throws std::invalid_argument for every
/// deviation from the format. The message is one line with the file, the line and the key or value. May block on the
/// disk. Thread-safe. Reading the meshes takes most of the time.
GLISSADE_EXPORT Scene read_scene(const std::filesystem::path& path);

/// Like `read_scene`, for a text in memory. `source` replaces the name of the file in messages. Paths in the scene are
/// relative to `base_folder`.
GLISSADE_EXPORT Scene parse_scene(const std::string& text, const std::string& source,
                                  const std::filesystem::path& base_folder);

/// Writes a scene file. `read_scene` reads an equal scene from this file, in which every number is bit-identical. The
/// file has all objects, with poses as matrices, motions row by row, and shapes by their parameters. Mesh files and the
/// script are not copied: the scene file has their paths, relative to its folder. A mesh given as a value is written to
/// STEM_N.obj in the same folder, where N is the number of the object (from 1). Objects that share such a mesh share
/// the file.
///
/// An existing file with the same content is kept. If an existing file has other content, nothing is written.
///
/// Throws std::invalid_argument, naming the file or the object, in these cases:
/// - An existing file has other content, or the folder does not exist.
/// - The scene has hands, or a value that scene files cannot hold: rules, metaphor, stiffness or upward direction other
///   than the default.
/// - `bodies_of` refuses an object.
/// - A name is empty or is not UTF-8.
/// - A rotation has a `geometry::rotation_defect` above 1e-12.
/// - A time in nanoseconds is not exactly representable as a number of seconds (beyond some 26 days).
/// - The triangles that give way are not exactly the triangles inside a set of axis-aligned boxes.
/// - A value is out of range.
///
/// Throws std::runtime_error if not everything could be written, for example on a full disk. May block on the disk.
/// Thread-safe, except for calls that write the same file. Cost: linear in the size of the meshes. Each box of
/// triangles that give way adds a cost linear in the triangles of the object.
GLISSADE_EXPORT void write_scene(const Scene& scene, const std::filesystem::path& path);

/// A part that hands can hold.
struct ScenePart {
  std::string name;
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
};

/// The objects of a scene, prepared for contact. Obstacles with the same mesh share a body. Bodies are numbered as in
/// contacts: first the obstacles, then the parts, then the objects that move on their own.
struct GLISSADE_EXPORT SceneBodies {
  std::string source;            ///< `Scene::source`
  std::vector<ScenePart> parts;  ///< at least one
  std::vector<contact::Obstacle> obstacles;
  std::vector<contact::ScriptedPart> moving;  ///< the objects that move on their own
  std::vector<std::string> body_names;        ///< by number of the body
  std::optional<Eigen::Isometry3d> X_WGoal;   ///< goal pose of the first part

  /// Number of the part with this name; std::nullopt if no part has this name.
  std::optional<std::size_t> part_number(const std::string& name) const;
  /// The names of all parts, in quotes, for messages.
  std::string part_names() const;
};

/// The objects with the names `part_names` become the parts, in this order. All other movable objects become obstacles.
/// Throws std::invalid_argument, naming the scene and the object, in these cases:
/// - A name in `part_names` belongs to no object, or the scene has only one object.
/// - An object has no mesh, has no area at its pose, or reaches beyond ±1e9 m.
/// - A part moves on its own, or is named twice.
/// - Two objects have the same name.
/// - The numbers of triangles that give way do not ascend, or are out of range.
/// - There are more than `contact::kMaxParts` parts and objects that move on their own.
///
/// Building the trees of the meshes takes most of the time.
///
/// An object whose mesh, and compliance point if it is a part, are those of a body in `known` shares this body. So
/// scenes that differ in poses only share all bodies.
GLISSADE_EXPORT SceneBodies bodies_of(const Scene& scene, const std::vector<std::string>& part_names,
                                      std::span<const SceneBodies> known = {});

/// A hash of all that a simulation takes from a scene: meshes, poses, margins, compliance points and scripts.
GLISSADE_EXPORT std::uint64_t hash_of(const SceneBodies& bodies);

/// All parts of a simulation: first the parts that hands can hold, then the objects that move on their own. For the
/// stiffness, see `Scene`.
GLISSADE_EXPORT std::vector<contact::HeldPart> held_parts(const SceneBodies& bodies, contact::Metaphor metaphor,
                                                          double stiffness_N_per_m);

/// The models of hands. Hands of the same shape share a model.
GLISSADE_EXPORT std::vector<std::shared_ptr<const grasping::HandModel>> hand_models(
    std::span<const grasping::HandShape> hands);

/// The mesh of an object without the triangles that give way.
GLISSADE_EXPORT std::shared_ptr<const geometry::TriangleMesh> stopping_mesh(const SceneObject& object);

}  // namespace glissade::simulation
