#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

#include "io/format_guess.h"
#include "io/mesh_readers.h"

namespace glissade::geometry {
namespace {

struct Format {
  const char* extension;
  const char* name;
  TriangleSoup (*read)(MeshFile& file);
};

constexpr std::array<Format, 5> kFormats{{{".obj", "OBJ", &read_obj},
                                          {".stl", "STL", &read_stl},
                                          {".ply", "PLY", &read_ply},
                                          {".gltf", "glTF", &read_gltf},
                                          {".glb", "glTF", &read_gltf}}};

const Format& format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  reject(path, "the format '" + extension + "' is not known; known are .obj, .stl, .ply, .gltf and .glb");
}

void check_used_vertices(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) {
      const std::optional<double> bad = bad_coordinate(mesh.vertices[static_cast<std::size_t>(corner)]);
      if (bad) reject_coordinate(path, "after scaling", *bad);
    }
  }
}

std::int64_t drop_degenerate(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const auto at = [&](std::size_t corner) { return mesh.vertices[static_cast<std::size_t>(t[corner])]; };
    return is_degenerate({at(0), at(1), at(2)});
  });
  return static_cast<std::int64_t>(before - mesh.triangles.size());
}

// Triangles without area count, too. Those with two equal corners do not: they have no edges to join.
bool has_two_triangles_at_every_edge(const TriangleMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) continue;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (i + 1 == edges.size() || edges[i] != edges[i + 1]) return false;
    if (i + 2 < edges.size() && edges[i] == edges[i + 2]) return false;
  }
  return true;
}

/// Reads the file as its name says. The message of an error says if the content looks like another format.
TriangleSoup read_as_named(MeshFile& file) {
  const Format& format = format_of(file.path());
  try {
    return format.read(file);
  } catch (const std::invalid_argument& error) {
    constexpr std::uint64_t kBeginning = 4096;
    const std::string_view guess = format_guess(file.beginning(kBeginning), file.size());
    if (guess.empty() || guess == format.name) throw;
    throw std::invalid_argument(std::string(error.what()) + " By its name it is " + format.name +
                                ", by its content it seems to be " + std::string(guess) + ".");
  }
}

/// What the file has, in metres.
TriangleSoup read_soup(const std::filesystem::path& path, double scale) {
  if (!std::isfinite(scale) || scale <= 0) {
    std::ostringstream message;
    message << "the scale must be positive and finite, but is " << scale;
    reject(path, message.str());
  }
  MeshFile file(path);
  TriangleSoup soup = read_as_named(file);
  for (Eigen::Vector3d& vertex : soup.mesh.vertices) {
    vertex *= scale;
  }
  check_used_vertices(path, soup.mesh);
  return soup;
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path, double scale) {
  TriangleSoup soup = read_soup(path, scale);
  ImportedMesh result;
  result.warnings = std::move(soup.warnings);
  result.polygons_triangulated = soup.polygons_triangulated;
  result.mesh = weld(soup.mesh);
  result.degenerate_triangles = drop_degenerate(result.mesh);
  if (result.degenerate_triangles > 0) {
    result.closed_by_degenerate = has_two_triangles_at_every_edge(weld(soup.mesh));
    result.mesh = weld(result.mesh);  // drops the vertices that only they used
  }
  if (result.mesh.triangles.empty()) {
    reject(path, "none of its " + std::to_string(result.degenerate_triangles) + " triangles has an area");
  }
  return result;
}

ImportedMesh import_unwelded_mesh(const std::filesystem::path& path, double scale) {
  TriangleSoup soup = read_soup(path, scale);
  return {.mesh = std::move(soup.mesh),
          .polygons_triangulated = soup.polygons_triangulated,
          .warnings = std::move(soup.warnings)};
}

}  // namespace glissade::geometry
