#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/open_files.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/apps/wait_notice.h>
#include <glissade/files/file_checks.h>
#include <glissade/geometry/mesh_import.h>

namespace glissade::apps {

namespace {

void say_what_is_left_out(const std::string& mesh, std::int64_t triangles) {
  if (triangles == 0) return;
  say("glissade: " + one_line(mesh) + ": " +
      (triangles == 1 ? "1 triangle without area is" : std::to_string(triangles) + " triangles without area are") +
      " left out");
}

/// Set by `--strict`, for all that the program opens.
bool& is_strict() {
  static bool strict = false;
  return strict;
}

/// Each warning is said once, however often its file is opened.
void warn_or_refuse(const std::string& warning) {
  if (is_strict()) throw std::invalid_argument(warning + " With --strict this is an error.");
  static std::set<std::string> said;
  if (said.insert(warning).second) warn(warning);
}

}  // namespace

void add_strict_option(CLI::App& command) {
  command.add_flag("--strict", is_strict(), "Treat warnings about the content of mesh files as errors");
}

geometry::ImportedMesh import_with_warnings(const std::string& path, double scale) {
  check_input(path);
  const WaitNotice notice("reading " + path);
  geometry::ImportedMesh imported = geometry::import_mesh(path, scale);
  for (const std::string& sentence : imported.warnings)
    warn_or_refuse(path + ": " + sentence);
  return imported;
}

std::shared_ptr<const geometry::TriangleMesh> open_mesh(const std::string& path, double scale) {
  geometry::ImportedMesh imported = import_with_warnings(path, scale);
  say_what_is_left_out(path, imported.degenerate_triangles);
  return std::make_shared<const geometry::TriangleMesh>(std::move(imported.mesh));
}

Scene open_scene(const std::string& path) {
  const auto read = [&path] {
    const WaitNotice notice("reading " + path + " and its meshes");
    return read_scene(path);
  };
  Scene scene = read();
  std::set<const geometry::TriangleMesh*> said;
  for (const SceneObject& object : scene.objects) {
    const SceneMesh& mesh = object.mesh;
    if (!said.insert(mesh.shared().get()).second) continue;
    for (const std::string& warning : mesh.warnings())
      warn_or_refuse(warning);
    say_what_is_left_out(path + ": the mesh of object " + in_quotes(object.name), mesh.degenerate_triangles());
  }
  return scene;
}

}  // namespace glissade::apps
