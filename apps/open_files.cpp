#include <cstdint>
#include <set>
#include <utility>

#include <glissade/apps/files/input_files.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/geometry/mesh_import.h>

namespace glissade::apps {

namespace {

void say_what_is_left_out(const std::string& mesh, std::int64_t triangles) {
  if (triangles == 0) return;
  say("glissade: " + one_line(mesh) + ": " +
      (triangles == 1 ? "1 triangle without area is" : std::to_string(triangles) + " triangles without area are") +
      " left out");
}

}  // namespace

std::shared_ptr<const geometry::TriangleMesh> open_mesh(const std::string& path, double scale) {
  note_input(path);
  geometry::ImportedMesh imported = geometry::import_mesh(path, scale);
  say_what_is_left_out(path, imported.degenerate_triangles);
  return std::make_shared<const geometry::TriangleMesh>(std::move(imported.mesh));
}

Scene open_scene(const std::string& path) {
  Scene scene = read_scene(path);
  std::set<const geometry::TriangleMesh*> said;
  for (const SceneObject& object : scene.objects) {
    if (!said.insert(object.mesh.get()).second) continue;
    say_what_is_left_out(path + ": the mesh of object " + in_quotes(object.name), object.degenerate_triangles);
  }
  return scene;
}

}  // namespace glissade::apps
