#pragma once

/// The binary container of glTF (GLB).

#include <string>
#include <string_view>

#include "io/mesh_file.h"
#include "io/mesh_warnings.h"

namespace glissade::geometry {

/// The chunks of a container, views of its bytes.
struct GlbChunks {
  std::string_view text;    // JSON
  std::string_view binary;  // the first buffer; empty if there is none
};

/// Whether a file begins as a container does.
inline bool is_glb(std::string_view bytes) {
  return bytes.starts_with("glTF");
}

/// The bytes of the container. Throws std::invalid_argument for a header that is not of version 2 and for a file that
/// is shorter than its header says. Warns of a file that is longer, of which the rest is not read.
std::string glb_content(MeshFile& file, MeshWarnings& warnings);

/// The chunks in the bytes of a container. Throws std::invalid_argument for a truncated chunk.
GlbChunks glb_chunks(const std::filesystem::path& path, std::string_view bytes);

}  // namespace glissade::geometry
