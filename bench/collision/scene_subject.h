#pragma once

/// The subjects of the benches of scenes: Glissade's collision pipeline, and other libraries with their broad phase and
/// their test of two meshes, combined as their manuals describe. Small adapters give all of them one interface.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/frame_result.h>

#include "scene.h"
#include "subject.h"

namespace glissade::bench {

/// Two objects of a scene.
using NumberPair = std::pair<std::size_t, std::size_t>;

/// The objects of a scene in one library.
class SceneSubject {
 public:
  virtual ~SceneSubject() = default;

  /// One frame: takes new poses and finds all pairs of objects that meet. Only this function is timed.
  virtual void step(std::span<const MovedObject> moved) = 0;
  /// The pairs found, in any order.
  virtual std::vector<NumberPair> meeting() const = 0;
  /// Report on the last frame; null for subjects without one.
  virtual const collision::FrameReport* report() const { return nullptr; }
};

/// An object as a subject receives it. Its index is its number.
struct SceneObject {
  const Model* model;  ///< shared by all objects of the same mesh
  Eigen::Isometry3d X_WO;
};

struct SceneLibrary {
  std::string name;
  std::string model;  ///< libraries with the same `model` share the models built
  std::function<std::unique_ptr<Model>(const geometry::TriangleMesh&)> build;
  std::function<std::unique_ptr<SceneSubject>(std::span<const SceneObject> objects)> start;
};

/// "glissade"; on more than one thread "glissade-2-threads".
SceneLibrary glissade_scenes(int threads);
SceneLibrary fcl_scenes();
SceneLibrary ode_scenes();
SceneLibrary bullet_scenes();

}  // namespace glissade::bench
