#pragma once

/// What the first bytes of a mesh file say of its size.

#include <filesystem>

namespace glissade::geometry {

/// Rejects a large file whose first bytes do not belong to the format of its extension, or say another size, before
/// it is read whole. Files that it lets pass are not valid for that.
void check_head(const std::filesystem::path& path);

}  // namespace glissade::geometry
