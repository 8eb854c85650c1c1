#pragma once

/// The meshes of the scenes, and the models that each library builds of them, once for all objects and scenes.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene.h"
#include "scene_subject.h"

namespace glissade::bench {

class SceneCast {
 public:
  SceneCast();

  /// Radii of the bounding spheres of the meshes about their origins, metres.
  const std::vector<double>& radii() const { return radii_; }
  /// The objects of the scene in a library, in their order. The cast must outlive them.
  std::unique_ptr<SceneSubject> start(const SceneLibrary& library, const Scene& scene);

 private:
  std::vector<geometry::TriangleMesh> meshes_;
  std::vector<double> radii_;
  std::map<std::string, std::vector<std::unique_ptr<Model>>> models_;
};

}  // namespace glissade::bench
