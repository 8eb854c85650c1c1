#pragma once

/// The placement of a glTF node in its parent.

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// A copy of the node with its placement only: its matrix, or its translation, rotation and scale, with the quaternion
/// scaled to unit length. Throws std::invalid_argument for an invalid placement, naming the file and the node `where`.
nlohmann::json copied_placement(const std::filesystem::path& path, const nlohmann::json& node,
                                const std::string& where);

}  // namespace glissade::geometry
