#include "mesh_import_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_pair.h>

#include "mesh_seeds.h"
#include "temporary_folder.h"

namespace glissade::fuzz {
namespace {

using geometry::TriangleMesh;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

bool is_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// What mesh_import.h promises of every mesh.
void check(const geometry::TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh without triangles");
  std::vector<bool> is_used(mesh.vertices.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) {
      require(corner >= 0 && static_cast<std::size_t>(corner) < mesh.vertices.size(), "an index out of range");
      is_used[static_cast<std::size_t>(corner)] = true;
    }
    const auto at = [&](std::size_t corner) { return mesh.vertices[static_cast<std::size_t>(triangle[corner])]; };
    require(!geometry::is_degenerate({at(0), at(1), at(2)}), "a triangle without area");
  }
  require(std::find(is_used.begin(), is_used.end(), false) == is_used.end(), "a vertex that no triangle uses");
  std::vector<Eigen::Vector3d> sorted = mesh.vertices;
  for (const Eigen::Vector3d& vertex : sorted) {
    for (const double coordinate : vertex) {
      require(std::isfinite(coordinate) && std::abs(coordinate) <= 1e9, "a coordinate out of range");
    }
  }
  std::sort(sorted.begin(), sorted.end(), is_before);
  const auto twins =
      std::adjacent_find(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a == b; });
  require(twins == sorted.end(), "vertices that are not welded");
}

void check_message(const std::string& message) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  require(std::none_of(message.begin(), message.end(), is_control), "a message with control characters");
  require(message.size() < 2000, "a message that is too long");
}

/// The file under test, and next to it one that a glTF document may refer to.
class Files {
 public:
  Files() { folder_.write("data.bin", mesh_buffer()); }
  std::string write(const std::string& extension, std::string_view bytes) const {
    return folder_.write("mesh" + extension, std::string(bytes));
  }

 private:
  test_support::TemporaryFolder folder_;
};

}  // namespace

bool try_mesh_import(const std::string& extension, std::string_view bytes) {
  static const Files files;
  const std::string path = files.write(extension, bytes);
  try {
    const geometry::ImportedMesh imported = geometry::import_mesh(path);
    require(imported.degenerate_triangles >= 0 && imported.polygons_triangulated >= 0, "a negative count");
    check(imported.mesh);
    require(imported.warnings.size() < 30, "more warnings than kinds");
    for (const std::string& warning : imported.warnings)
      check_message(warning);
    require(std::isfinite(geometry::report(imported.mesh).area), "an area that is not finite");
    return true;
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    require(message.starts_with(path), "a message that does not begin with the name of the file");
    check_message(message);
    return false;
  }
}

}  // namespace glissade::fuzz
