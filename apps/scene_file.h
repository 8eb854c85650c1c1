#pragma once

/// Scenes as YAML files: what lies where, what can be moved, and where it should arrive.
///
///     objects:
///       - name: door                       # unique
///         mesh: door.stl                   # relative to the scene file
///         scale: 0.001                     # mesh units to metres, default 1; not for shapes
///       - name: motor
///         shape: {type: sphere, radius_m: 0.05}      # or a generator of shape_catalog.h instead of a mesh
///         pose: {position_m: [0, 0, 0.4], orientation_wxyz: [1, 0, 0, 0]}      # X_WB, default identity
///         movable: true                    # default false
///         margin_m: 2.0e-6                 # contacts hold parts this far away, default that of the part
///         gives_way: [{min_m: [0, 0, 0], max_m: [0.1, 0.1, 0.01]}]     # boxes in the object's frame: its triangles
///                                          # inside them hold no part, where it overlaps by design when it is seated
///       - name: lift
///         mesh: lift.stl
///         moves: lift.csv                  # poses X_WB over time, relative to the scene file; instead of pose.
///                                          # Outside its times it stands still; at first it must touch nothing
///         grip_N_per_m: 1.0e+6             # how stiffly it is held there, default 1e6; 1000 is another hand
///     script: hand.csv                     # optional: trajectory of the hand root, relative to the scene file
///     goal: {position_m: [0, 0, 0]}        # optional: pose where the movable part should arrive

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/triangle_mesh.h>
#include <glissade/devices/pose_trajectory.h>

namespace glissade::apps {

/// How an object moves on its own, or in the other hand.
struct SceneMotion {
  devices::PoseTrajectory script_X_WB;
  std::optional<double> grip_N_per_m{};  ///< none: that of `haptics::ScriptedPart`
};

/// One object at its initial pose.
struct SceneObject {
  std::string name;
  std::shared_ptr<const collision::TriangleMesh> mesh;  ///< in metres, in the object's frame B; equal ones are shared
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  bool movable = false;
  std::optional<SceneMotion> motion{};
  std::optional<double> margin_m{};
  std::vector<std::int32_t> giving_way{};  ///< triangles, ascending
  std::int64_t degenerate_triangles = 0;   ///< left out of the mesh, see `import_mesh`
};

/// A scene with at least one object; all names differ.
struct Scene {
  std::string source;  ///< the file's name, for messages
  std::vector<SceneObject> objects;
  std::optional<std::string> script_path;
  std::optional<Eigen::Isometry3d> X_WGoal;

  /// Throws std::invalid_argument, listing the known names, when there is no object `name`.
  const SceneObject& find(const std::string& name) const;
};

/// Reads a scene and the meshes it names.
/// Throws std::invalid_argument, one line with file, line and key or value, for everything that is not as described
/// above.
Scene read_scene(const std::string& path);

/// The same for a text that is already in memory: `source` stands in for the file's name in messages, and paths in the
/// scene are relative to `base_folder`.
Scene parse_scene(const std::string& text, const std::string& source, const std::string& base_folder);

}  // namespace glissade::apps
