#pragma once

/// What can be simulated, and so be written.

#include <string>

#include <glissade/simulation/scene.h>

namespace glissade::simulation {

/// Scene and object, for messages.
std::string named(const Scene& scene, const SceneObject& object);

/// Throws std::invalid_argument, naming scene and object, as `bodies_of` tells of names, meshes and triangles that give
/// way.
void check_scene(const Scene& scene);

}  // namespace glissade::simulation
