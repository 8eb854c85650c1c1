#pragma once

/// Meshes and scenes as commands open them: read, with a line on standard error for each mesh from which triangles
/// without area were left out. Both throw std::invalid_argument as `import_mesh` and `read_scene` do.

#include <memory>
#include <string>

#include <glissade/apps/files/scene_file.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// `scale` is the number of metres in a unit of the file.
std::shared_ptr<const geometry::TriangleMesh> open_mesh(const std::string& path, double scale = 1.0);

/// Objects that share a mesh make one line, which names the first of them.
Scene open_scene(const std::string& path);

}  // namespace glissade::apps
