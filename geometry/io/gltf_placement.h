#pragma once

/// Where a glTF node stands in its parent.

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// A copy of the node with nothing but its matrix, or its translation, rotation and scale; the rotation has exactly
/// unit length. Throws std::invalid_argument for numbers that place nothing, naming the file and `where`, the node.
nlohmann::json copied_placement(const std::filesystem::path& path, const nlohmann::json& node,
                                const std::string& where);

}  // namespace glissade::geometry
