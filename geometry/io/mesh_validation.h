#pragma once

/// Strict reading of mesh files before the importer library sees them.
///
/// The library crashes, hangs or makes up geometry on broken files. So each function here reads a whole file, throws
/// std::invalid_argument for the first thing that is wrong, naming the file and the place, and returns a clean file of
/// the same format with nothing but the geometry in it.

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
/// Both kinds come back as one GLB. Reads the buffers that lie in files of their own.
VettedFile vetted_gltf(const std::filesystem::path& path, std::string_view bytes);
VettedFile vetted_glb(const std::filesystem::path& path, std::string_view bytes);

/// The whole content of a regular file that is not empty.
std::string file_content(const std::filesystem::path& path);

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& what);

/// Rejects coordinates that are not finite or beyond ±1e9; `where` is the line or element.
void check_coordinate(const std::filesystem::path& path, const std::string& where, double value);

}  // namespace glissade::geometry
