#pragma once

/// The placement of a glTF node in its parent.

#include <filesystem>
#include <string>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The placement of a node in its parent: X_ParentNode from its matrix, or from its translation, rotation and scale. It
/// may scale and shear. Throws std::invalid_argument for an invalid placement, naming the file and the node `where`.
Eigen::Affine3d placement(const std::filesystem::path& path, const nlohmann::json& node, const std::string& where);

}  // namespace glissade::geometry
