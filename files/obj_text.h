#pragma once

/// Meshes as Wavefront OBJ.

#include <cstddef>
#include <string>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::files {

/// Appends vertices and triangles. `first` is the number of the mesh's first vertex in the file (OBJ counts from 1).
/// Numbers read back exactly, including the sign of zeros.
void append_obj(std::string& text, const geometry::TriangleMesh& mesh, std::size_t first = 1);

}  // namespace glissade::files
