#pragma once

/// One reader for each format of mesh files.
///
/// A reader looks at every byte, and returns the triangles in double precision: decimal digits and doubles as the file
/// has them, floats and integers without any loss. It throws std::invalid_argument for the first error, naming the file
/// and the place. Sizes that a header promises are compared with the size of the file before the content is read, and
/// no memory is reserved for content that the file does not have.

#include <cstdint>

#include <glissade/geometry/triangle_mesh.h>

#include "io/mesh_file.h"

namespace glissade::geometry {

/// The triangles of a file, with indices in range. Vertices may coincide or be unused, and triangles be degenerate.
struct TriangleSoup {
  TriangleMesh mesh;  ///< in the units of the file
  std::int64_t polygons_triangulated = 0;
};

TriangleSoup read_obj(MeshFile& file);
TriangleSoup read_stl(MeshFile& file);
TriangleSoup read_ply(MeshFile& file);
/// Buffers in separate files are read too.
TriangleSoup read_gltf(MeshFile& file);
TriangleSoup read_glb(MeshFile& file);

}  // namespace glissade::geometry
