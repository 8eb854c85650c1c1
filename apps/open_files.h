#pragma once

/// Meshes and scenes as commands open them: read, with a line on standard error for each mesh from which triangles
/// without area were left out, and one for each warning of a mesh file. All throw std::invalid_argument as
/// `import_mesh` and `read_scene` do, and with `--strict` for a warning.

#include <memory>
#include <string>

#include <glissade/apps/files/scene_file.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/triangle_mesh.h>

namespace CLI {
class App;
}

namespace glissade::apps {

/// Adds the option `--strict` to a command that opens meshes or scenes.
void add_strict_option(CLI::App& command);

/// `scale` is the number of metres in a unit of the file. Says nothing of triangles without area.
geometry::ImportedMesh import_with_warnings(const std::string& path, double scale);

/// The same as `import_with_warnings`, and says how many triangles were left out.
std::shared_ptr<const geometry::TriangleMesh> open_mesh(const std::string& path, double scale = 1.0);

/// Objects that share a mesh make one line, which names the first of them.
Scene open_scene(const std::string& path);

}  // namespace glissade::apps
