#pragma once

/// The option --cache of the commands that read meshes.

#include <memory>
#include <string>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// The option's help.
inline constexpr const char* kCacheHelp =
    "Store the DOP-tree (bounding-volume hierarchy) of each mesh beside it, in MESH.dop-tree, and reuse that file";

/// The tree of a mesh. With an empty `mesh_path`, the tree is built. Otherwise the tree is read from the file beside
/// the mesh; if that file does not contain the tree of this mesh, the tree is built and written there. A line on
/// standard error reports a file that cannot be used or written. Throws as DopTree does.
collision::DopTree load_or_build_tree(const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                                      const std::string& mesh_path);

}  // namespace glissade::apps
