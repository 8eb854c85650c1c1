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
  bool closed_by_degenerate = false;       ///< with those triangles, exactly two would meet at every edge
  std::int64_t polygons_triangulated = 0;  ///< faces of more than three corners in the file
  /// What was skipped or found missing in the file, at most one sentence of each kind: "2 faces have fewer than 3
  /// corners and are left out (the first: line 21)."
  std::vector<std::string> warnings;
};

/// Reads all meshes of a file into one mesh; of a glTF file, those of its default scene, placed and deformed as they
/// are there. Vertices at identical positions are welded, polygons are triangulated, and degenerate triangles are
/// dropped. Normals, texture coordinates, materials, lines and points are ignored. Coordinates are multiplied by
/// `scale` (metres per unit of the file). What else is skipped, such as unknown statements and faces of two corners, is
/// in the warnings.
///
/// Coordinates are read in double precision: the decimal digits of text, also where a PLY header declares floats, and
/// the numbers of binary files as they are. Scaling, and what glTF does with its points, round further, to about 1e-16.
///
/// Throws std::invalid_argument for a file that is missing, not a regular file, of unknown format, unreadable, empty,
/// truncated, larger than 16 GiB or otherwise broken, and for text in UTF-16; for coordinates of triangles that are not
/// finite or beyond ±1e9, before or after scaling; for indices out of range; when all triangles are degenerate; for
/// surfaces in OBJ that are not polygons; for glTF that is only compressed, that requires an unknown extension, or
/// whose buffers lie outside its folder; and for a scale that is not positive and finite. The message is one line that
/// names the file and the faulty line, element or value. May block on the disk.
ImportedMesh import_mesh(const std::filesystem::path& path, double scale = 1.0);

/// The same, but vertices and triangles are as the file has them: nothing is welded or dropped. Vertices that no
/// triangle uses need not be finite.
ImportedMesh import_unwelded_mesh(const std::filesystem::path& path, double scale = 1.0);

}  // namespace glissade::geometry
