#pragma once

/// Triangle meshes from files: Wavefront OBJ, STL and PLY (text and binary), glTF 2.0 (.gltf and .glb).

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// An imported mesh, and counts of the changes made on import.
struct ImportedMesh {
  TriangleMesh mesh;                       ///< of `import_mesh`: welded, and no triangle is degenerate
  std::int64_t degenerate_triangles = 0;   ///< triangles without area, left out of `mesh`
  bool closed_by_degenerate = false;       ///< with the left-out triangles, exactly two would meet at every edge
  std::int64_t polygons_triangulated = 0;  ///< faces of more than three corners in the file
  /// Sentences about items that were skipped or missing, at most one sentence for each kind: "2 faces have fewer than 3
  /// corners and are left out (the first: line 21)."
  std::vector<std::string> warnings;
};

/// Reads all meshes of a file into one mesh. Of a glTF file, it reads the meshes of the default scene, as the scene
/// places and deforms them. Vertices at identical positions are welded, polygons are triangulated, and degenerate
/// triangles are dropped. Normals, texture coordinates, materials, lines and points are ignored. Coordinates are
/// multiplied by `scale` (metres per unit of the file). Warnings tell of other skipped items, such as unknown
/// statements and faces of two corners.
///
/// Coordinates are read in double precision, also from a text PLY whose header declares floats. Scaling and the
/// deformations of glTF round further, to about 1e-16.
///
/// Throws std::invalid_argument for a file that is missing, not a regular file, of unknown format, unreadable, empty,
/// truncated, larger than 16 GiB or otherwise broken, for text in UTF-16, and for a scale that is not positive and
/// finite. Also throws for coordinates of triangles that are not finite or beyond ±1e9, before or after scaling, for
/// indices out of range, and when all triangles are degenerate. Surfaces in OBJ must be polygons. glTF must not be only
/// compressed, must not require an unknown extension, and must have its buffers inside its folder. The message is one
/// line that names the file and the faulty line, element or value. May block on the disk.
ImportedMesh import_mesh(const std::filesystem::path& path, double scale = 1.0);

/// The same, but vertices and triangles are as the file has them: nothing is welded or dropped. Vertices that no
/// triangle uses need not be finite.
ImportedMesh import_unwelded_mesh(const std::filesystem::path& path, double scale = 1.0);

}  // namespace glissade::geometry
