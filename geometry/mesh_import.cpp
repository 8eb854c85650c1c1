#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

#include "io/mesh_readers.h"

namespace glissade::geometry {
namespace {

struct Format {
  const char* extension;
  TriangleSoup (*read)(MeshFile& file);
};

constexpr std::array<Format, 5> kFormats{
    {{".obj", &read_obj}, {".stl", &read_stl}, {".ply", &read_ply}, {".gltf", &read_gltf}, {".glb", &read_glb}}};

const Format& format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  reject(path, "The format '" + extension + "' is not known; known are .obj, .stl, .ply, .gltf and .glb");
}

std::int64_t drop_degenerate(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const auto at = [&](std::size_t corner) { return mesh.vertices[static_cast<std::size_t>(t[corner])]; };
    return is_degenerate({at(0), at(1), at(2)});
  });
  return static_cast<std::int64_t>(before - mesh.triangles.size());
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path, double scale) {
  if (!std::isfinite(scale) || scale <= 0) {
    std::ostringstream message;
    message << "The scale must be positive and finite, but is " << scale;
    reject(path, message.str());
  }
  MeshFile file(path);
  TriangleSoup soup = format_of(path).read(file);
  for (Eigen::Vector3d& vertex : soup.mesh.vertices) {
    vertex *= scale;
    for (const double coordinate : vertex) {
      if (!is_coordinate(coordinate)) reject_coordinate(path, "After scaling", coordinate);
    }
  }
  ImportedMesh result;
  result.polygons_triangulated = soup.polygons_triangulated;
  result.mesh = weld(soup.mesh);
  result.degenerate_triangles = drop_degenerate(result.mesh);
  if (result.degenerate_triangles > 0) result.mesh = weld(result.mesh);  // drops the vertices that only they used
  if (result.mesh.triangles.empty()) {
    reject(path, "None of its " + std::to_string(result.degenerate_triangles) + " triangles has an area");
  }
  return result;
}

}  // namespace glissade::geometry
