#include <iostream>
#include <utility>

#include <glissade/apps/commands/load_or_build_tree.h>
#include <glissade/apps/text.h>
#include <glissade/apps/wait_notice.h>
#include <glissade/collision/dop_tree.h>

namespace glissade::apps {

collision::DopTree load_or_build_tree(const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                                      const std::string& mesh_path) {
  const WaitNotice notice("reading or building the tree of a mesh of " + std::to_string(mesh->triangles.size()) +
                          " triangles");
  if (mesh_path.empty()) return collision::DopTree(mesh);
  collision::LoadedTree loaded = collision::load_or_build_tree(mesh_path, mesh);
  if (!loaded.note.empty()) std::cerr << "glissade: " << one_line(loaded.note) << '\n';
  return std::move(loaded.tree);
}

}  // namespace glissade::apps
