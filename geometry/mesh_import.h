#pragma once

/// Triangle meshes from files: Wavefront OBJ, STL and PLY (text and binary), glTF 2.0 (.gltf and .glb).

#include <cstdint>
#include <filesystem>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// A mesh and what had to be done to it.
struct ImportedMesh {
  TriangleMesh mesh;                       ///< welded; every triangle has area
  std::int64_t degenerate_triangles = 0;   ///< triangles without area, left out of `mesh`
  std::int64_t polygons_triangulated = 0;  ///< faces of more than three corners in the file
};

/// Reads the geometry of a file: all meshes of the file, placed by its nodes, as one mesh, vertices at identical
/// positions welded, polygons triangulated. Normals, texture coordinates, materials, lines and points are ignored.
/// Coordinates are multiplied by `scale` (metres per unit of the file).
///
/// The vertices pass through single precision, which rounds each coordinate in the file by up to 6e-8 of itself: 0.06
/// µm at one metre from the origin, but 0.06 mm at a kilometre. So meshes should lie near the origin of their file.
///
/// Throws std::invalid_argument, in one line that names the file and the line, element or value, for a file that is
/// missing, not a file, of unknown format, unreadable, empty, truncated or otherwise broken; for coordinates that are
/// not finite or beyond ±1e9 before or after scaling; for indices out of range; when no triangle has area; and for a
/// scale that is not positive and finite. Compressed and sparse glTF is refused. May block on the disk.
ImportedMesh import_mesh(const std::filesystem::path& path, double scale = 1.0);

}  // namespace glissade::geometry
