#pragma once

/// Import of triangle meshes from files: Wavefront OBJ, STL and PLY (text and binary), glTF 2.0 (.gltf and .glb).

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// An imported mesh, and counts of the changes that the import made.
struct ImportedMesh {
  TriangleMesh mesh;                       ///< from `import_mesh`: welded, without degenerate triangles
  std::int64_t degenerate_triangles = 0;   ///< triangles without area, left out of `mesh`
  bool closed_by_degenerate = false;       ///< whether, with the omitted triangles, each edge has exactly two triangles
  std::int64_t polygons_triangulated = 0;  ///< faces of more than three corners in the file
  /// Sentences about items that were skipped or missing, at most one sentence for each kind of item. Example: "2 faces
  /// have fewer than 3 corners and are left out (the first: line 21)."
  std::vector<std::string> warnings;
};

/// Reads all meshes of a file into one mesh. From a glTF file, the function reads the meshes of the default scene, in
/// the poses and with the deformations of this scene. Vertices at identical positions are welded, polygons are
/// triangulated, and degenerate triangles are dropped. Normals, texture coordinates, materials, lines and points are
/// ignored. Warnings report skipped items, such as unknown statements and faces of two corners. Coordinates are
/// multiplied by `scale` (metres per unit of the file).
///
/// Coordinates are read in double precision, even from a text PLY whose header declares floats. Scaling and the
/// deformations of glTF add rounding errors of about 1e-16.
///
/// Throws std::invalid_argument in these cases:
/// - The file is missing, not a regular file, of unknown format, unreadable, empty, truncated, larger than 16 GiB or
///   otherwise broken.
/// - The text is in UTF-16.
/// - `scale` is not positive and finite.
/// - A coordinate of a triangle is not finite, or is beyond ±1e9 before or after scaling.
/// - An index is out of range.
/// - All triangles are degenerate.
/// - An OBJ file has surfaces other than polygons.
/// - A glTF file has only compressed data, requires an unknown extension, or has buffers outside its folder.
///
/// The message is one line that names the file and the faulty line, element or value. May block on the disk.
GLISSADE_EXPORT ImportedMesh import_mesh(const std::filesystem::path& path, double scale = 1.0);

/// Like `import_mesh`, but keeps vertices and triangles as in the file. Nothing is welded or dropped. Vertices that no
/// triangle uses need not be finite.
GLISSADE_EXPORT ImportedMesh import_unwelded_mesh(const std::filesystem::path& path, double scale = 1.0);

}  // namespace glissade::geometry
