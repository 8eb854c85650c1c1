#pragma once

/// Who says which objects of a scene meet: Glissade's collision pipeline, or another library with its broad phase and
/// its test of two meshes, put together as its manual has it. Each is made the same by a small adapter.

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

  /// A frame: takes new poses, finds out which pairs of all objects meet. This is what is timed.
  virtual void step(std::span<const MovedObject> moved) = 0;
  /// Those, in any order.
  virtual std::vector<NumberPair> meeting() const = 0;
  /// Account of the last frame, from who keeps one.
  virtual const collision::FrameReport* report() const { return nullptr; }
};

/// An object as a subject is given it; its number is its place among them.
struct SceneObject {
  const Model* model;  ///< shared by all objects of the same mesh
  Eigen::Isometry3d X_WO;
};

struct SceneLibrary {
  std::string name;
  std::string model;  ///< libraries of the same `model` share what was built
  std::function<std::unique_ptr<Model>(const geometry::TriangleMesh&)> build;
  std::function<std::unique_ptr<SceneSubject>(std::span<const SceneObject> objects)> start;
};

/// "glissade"; on more than one thread "glissade-2-threads".
SceneLibrary glissade_scenes(int threads);
SceneLibrary fcl_scenes();
SceneLibrary ode_scenes();
SceneLibrary bullet_scenes();

}  // namespace glissade::bench
