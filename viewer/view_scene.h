#pragma once

/// The objects and hands that a viewer shows, before anything moves.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::viewer {

/// An object of the scene. An object with a number `part` moves with the part of this number in `devices::HapticState`.
struct ViewObject {
  std::string name;
  std::shared_ptr<const geometry::TriangleMesh> mesh;  ///< metres, in the object's frame B; equal meshes are sent once
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  ///< at the start
  std::optional<std::size_t> part{};
  bool moves_on_its_own = false;  ///< a part that no hand can hold
};

/// A hand. Hands are numbered as in `devices::HapticState`.
struct ViewHand {
  std::string name{};                                  ///< such as "glove 1"
  std::shared_ptr<const grasping::HandModel> model{};  ///< null: no fingers; a viewer shows only the force
  std::vector<Eigen::Isometry3d> X_WL{};  ///< poses of the model's links; empty where the viewer moves the hand
};

struct ViewScene {
  std::string title;
  std::vector<ViewObject> objects;
  std::vector<ViewHand> hands;
  bool has_loop = true;  ///< a haptic loop moves the scene; its ticks may be late and its forces reduced
  std::optional<Eigen::Vector3d> p_WO_chosen{};

  /// The origin O of all coordinates that a viewer gets: `p_WO_chosen`, or by default the middle of the objects at
  /// their start. So single precision suffices even for a scene far from the world's origin.
  Eigen::Vector3d p_WO() const;
  /// The number of triangles of all objects.
  std::size_t triangles() const;
};

}  // namespace glissade::viewer
