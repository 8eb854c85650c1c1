#include <stdexcept>
#include <utility>

#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/shapes/shape_catalog.h>
#include <glissade/simulation/scene.h>

namespace glissade::simulation {

SceneMesh::SceneMesh(const std::filesystem::path& file, double scale, bool is_welded) {
  geometry::ImportedMesh imported =
      is_welded ? geometry::import_mesh(file, scale) : geometry::import_unwelded_mesh(file, scale);
  mesh_ = std::make_shared<const geometry::TriangleMesh>(std::move(imported.mesh));
  origin_ = {.file = std::filesystem::absolute(file), .scale = scale, .is_welded = is_welded};
  degenerate_triangles_ = imported.degenerate_triangles;
  for (const std::string& sentence : imported.warnings)
    warnings_.push_back(file.string() + ": " + sentence);
}

SceneMesh SceneMesh::of_shape(const std::string& type, const std::map<std::string, double>& parameters) {
  SceneMesh mesh = shapes::make_shape(type, parameters);
  mesh.origin_ = {.shape = type, .parameters = parameters};
  return mesh;
}

const SceneObject& Scene::find(const std::string& name) const {
  std::vector<std::string> known;
  for (const SceneObject& object : objects) {
    if (object.name == name) return object;
    known.push_back(object.name);
  }
  throw std::invalid_argument(source + ": there is no object " + files::in_quotes(name) +
                              files::did_you_mean(name, known) + " (known: " + files::joined(known) + ")");
}

std::vector<std::string> Scene::movable_names() const {
  std::vector<std::string> names;
  for (const SceneObject& object : objects) {
    if (object.movable) names.push_back(object.name);
  }
  return names;
}

std::optional<std::size_t> SceneBodies::part_number(const std::string& name) const {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].name == name) return p;
  }
  return std::nullopt;
}

std::string SceneBodies::part_names() const {
  std::vector<std::string> names;
  for (const ScenePart& part : parts)
    names.push_back(files::in_quotes(part.name));
  return files::joined(names);
}

}  // namespace glissade::simulation
