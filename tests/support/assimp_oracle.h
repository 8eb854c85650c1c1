#pragma once

/// Another reader of mesh files: assimp.

#include <cstdint>
#include <string>

namespace glissade::test_support {

/// The triangles that assimp reads, polygons cut; 0 if it refuses the file.
std::int64_t triangles_by_assimp(const std::string& path);

}  // namespace glissade::test_support
