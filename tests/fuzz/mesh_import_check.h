#pragma once

/// What the importer must do with any bytes.

#include <string>
#include <string_view>

namespace glissade::fuzz {

/// Imports the bytes as a file of the format with this extension. True for a mesh, false where std::invalid_argument
/// says why not. Throws std::logic_error for a mesh or a message that is not what mesh_import.h promises.
bool try_mesh_import(const std::string& extension, std::string_view bytes);

}  // namespace glissade::fuzz
