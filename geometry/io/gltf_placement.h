#pragma once

/// Placements in glTF documents: of a node in its parent, of an instance in its node, of a mesh in a joint.

#include <filesystem>
#include <span>
#include <string>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The placement of a node in its parent: X_ParentNode from its matrix, or from its translation, rotation and scale. It
/// may scale and shear. Throws std::invalid_argument for an invalid placement, naming the file and the node `where`.
Eigen::Affine3d placement(const std::filesystem::path& path, const nlohmann::json& node, const std::string& where);

/// The placement of 16 numbers, given column by column. Its last row must be 0, 0, 0, 1 up to rounding.
Eigen::Affine3d affine(const std::filesystem::path& path, std::span<const double> numbers, const std::string& where);

/// The rotation of the quaternion `xyzw`, given in this order. A deviation from unit length by rounding, up to
/// `tolerance`, is removed; any other would scale the mesh, and is rejected.
Eigen::Quaterniond unit_quaternion(const std::filesystem::path& path, std::span<const double> xyzw, double tolerance,
                                   const std::string& where);

}  // namespace glissade::geometry
