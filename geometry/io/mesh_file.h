#pragma once

/// Strict validation of mesh files before the importer library reads them.
///
/// The library crashes, hangs or invents geometry on broken files. So each `vetted_` function reads `bytes`, the
/// content of the whole file, and returns a clean file of the same format that contains the geometry only. It throws
/// std::invalid_argument for the first error, naming the file and the place.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace glissade::geometry {

struct VettedFile {
  std::string bytes;
  std::int64_t polygons_triangulated = 0;
};

VettedFile vetted_obj(const std::filesystem::path& path, std::string_view bytes);
VettedFile vetted_stl(const std::filesystem::path& path, std::string_view bytes);
VettedFile vetted_ply(const std::filesystem::path& path, std::string_view bytes);
/// Both kinds of glTF become one GLB. Buffers in separate files are read too.
VettedFile vetted_gltf(const std::filesystem::path& path, std::string_view bytes);
VettedFile vetted_glb(const std::filesystem::path& path, std::string_view bytes);

/// The whole content of a file; rejects a file that is missing, not regular, unreadable or empty.
std::string file_content(const std::filesystem::path& path);

/// Throws std::invalid_argument: `path` and `what` in one line, shortened and without control characters.
[[noreturn]] void reject(const std::filesystem::path& path, const std::string& what);

/// Rejects a coordinate that is not finite or beyond ±1e9; `where` names the line or element.
void check_coordinate(const std::filesystem::path& path, const std::string& where, double value);

}  // namespace glissade::geometry
