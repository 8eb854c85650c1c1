#pragma once

/// What a viewer shows: the objects of a scene and the hands, before anything moves.

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

/// An object of the scene. One with a part number moves as that part of `devices::HapticState` does.
struct ViewObject {
  std::string name;
  std::shared_ptr<const geometry::TriangleMesh> mesh;  ///< metres, in the object's frame B; equal meshes are sent once
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  ///< at the start
  std::optional<std::size_t> part{};
  bool moves_on_its_own = false;  ///< a part that no hand can hold
};

/// A hand, by its number in `devices::HapticState`.
struct ViewHand {
  std::string name{};                                  ///< such as "glove 1"
  std::shared_ptr<const grasping::HandModel> model{};  ///< null without fingers: only its force is shown
  std::vector<Eigen::Isometry3d> X_WL{};  ///< poses of the model's links; empty where the viewer moves the hand
};

struct ViewScene {
  std::string title;
  std::vector<ViewObject> objects;
  std::vector<ViewHand> hands;
  bool has_loop = true;  ///< a haptic loop moves it, whose ticks may be late and whose forces may be reduced
  std::optional<Eigen::Vector3d> p_WO_chosen{};

  /// The origin O of everything that a viewer gets: the one chosen, or else the middle of the objects at their start.
  /// Numbers in single precision are precise about that, wherever the scene is.
  Eigen::Vector3d p_WO() const;
  /// The number of triangles of all objects.
  std::size_t triangles() const;
};

}  // namespace glissade::viewer
