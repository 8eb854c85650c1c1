#pragma once

/// Random files in the dialects of OBJ, STL and PLY: the same closed mesh each time, written as some exporter might.

#include <cstdint>
#include <string>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

struct DialectFile {
  std::string name;  ///< with the extension of its format
  std::string content;
  bool is_text;
  bool has_warning;  ///< something is missing or must be skipped
};

/// File `number` of a fixed sequence.
DialectFile dialect_file(const TriangleMesh& mesh, std::uint64_t number);

}  // namespace glissade::geometry
