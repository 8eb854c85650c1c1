#pragma once

/// What `--cache` means to the commands that take meshes.

#include <memory>
#include <string>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// The option's help.
inline constexpr const char* kCacheHelp =
    "Keep the DOP-tree of each mesh in a file beside it, MESH.dop-tree, and read it from there";

/// The tree of a mesh: built, or where `mesh_path` is not empty, read from the file next to it if that is of use, else
/// built and written there. What is wrong with that file is told on standard error. Throws as DopTree does.
collision::DopTree load_or_build_tree(const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                                      const std::string& mesh_path);

}  // namespace glissade::apps
