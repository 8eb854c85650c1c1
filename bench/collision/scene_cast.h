#pragma once

/// The meshes of the scenes, and the models that each library has built of them, once for all objects and scenes.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench_options.h"
#include "scene.h"
#include "scene_subject.h"

namespace glissade::bench {

class SceneCast {
 public:
  SceneCast(std::vector<SceneLibrary> libraries, const BenchOptions& options);

  const std::vector<SceneLibrary>& libraries() const { return libraries_; }
  /// Radii of the bounding spheres of the meshes about their origins, metres.
  const std::vector<double>& radii() const { return radii_; }
  /// The objects of the scene in every library, in their order. The cast must outlive them.
  std::vector<std::unique_ptr<SceneSubject>> start(const Scene& scene) const;

 private:
  std::vector<SceneLibrary> libraries_;
  std::vector<double> radii_;
  std::map<std::string, std::vector<std::unique_ptr<Model>>> models_;
};

}  // namespace glissade::bench
