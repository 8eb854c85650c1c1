#pragma once

/// One reader for each format of mesh files.
///
/// A reader looks at every byte, and returns the triangles in double precision: decimal digits and doubles as the file
/// has them, floats and integers without any loss. What is certain is read, what is skipped is warned of, and what
/// makes the surface uncertain is an error: it throws std::invalid_argument for the first one, naming the file and the
/// place. Sizes that a header promises are compared with the size of the file before the content is read, and no memory
/// is reserved for content that the file does not have.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "io/mesh_file.h"

namespace glissade::geometry {

/// The triangles of a file, with indices in range. Vertices may coincide or be unused, and triangles be degenerate. A
/// vertex that no triangle uses need not be a point.
struct TriangleSoup {
  TriangleMesh mesh;  ///< in the units of the file
  std::int64_t polygons_triangulated = 0;
  std::vector<std::string> warnings{};
};

/// A coordinate of the vertex that is not finite or beyond ±1e9, if there is one.
inline std::optional<double> bad_coordinate(const Eigen::Vector3d& vertex) {
  for (const double coordinate : vertex) {
    if (!is_coordinate(coordinate)) return coordinate;
  }
  return std::nullopt;
}

TriangleSoup read_obj(MeshFile& file);
TriangleSoup read_stl(MeshFile& file);
TriangleSoup read_ply(MeshFile& file);
/// glTF as JSON or in a GLB container, whatever the name of the file says. Buffers in separate files are read too.
TriangleSoup read_gltf(MeshFile& file);

}  // namespace glissade::geometry
