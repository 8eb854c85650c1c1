#include "io/gltf_placement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

std::vector<double> numbers(const std::filesystem::path& path, const json& value, std::size_t length,
                            const std::string& where) {
  // The JSON library's own conversion accepts booleans too.
  const bool are_numbers = std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
  if (!value.is_array() || !are_numbers || value.size() != length)
    reject(path, where + " must have " + std::to_string(length) + " numbers");
  auto result = value.get<std::vector<double>>();
  for (const double number : result) {
    if (!is_coordinate(number)) reject_coordinate(path, where, number);
  }
  return result;
}

/// `numbers` are given column by column.
Eigen::Affine3d affine(const std::filesystem::path& path, const std::vector<double>& numbers,
                       const std::string& where) {
  const Eigen::Map<const Eigen::Matrix4d> matrix(numbers.data());
  const Eigen::RowVector4d row = matrix.row(3);
  if (row != Eigen::RowVector4d(0, 0, 0, 1)) {
    reject(path, where + ": its last row is " + json(std::vector<double>(row.begin(), row.end())).dump() +
                     ", not 0, 0, 0, 1");
  }
  return Eigen::Affine3d(Eigen::Matrix4d(matrix));
}

/// `xyzw` is given in this order. A deviation from unit length by rounding is removed; any other would scale the mesh,
/// and is rejected.
Eigen::Quaterniond unit_quaternion(const std::filesystem::path& path, const std::vector<double>& xyzw,
                                   const std::string& where) {
  const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (std::abs(q.norm() - 1.0) > 1e-3) {
    reject(path,
           where + ": the quaternion " + json(xyzw).dump() + " has the length " + json(q.norm()).dump() + ", not 1");
  }
  return q.normalized();
}

}  // namespace

Eigen::Affine3d placement(const std::filesystem::path& path, const json& node, const std::string& where) {
  const auto given = [&](const char* key, const std::vector<double>& otherwise) {
    return node.contains(key) ? numbers(path, node.at(key), otherwise.size(), where + "." + key) : otherwise;
  };
  for (const char* key : {"translation", "rotation", "scale"}) {
    if (node.contains("matrix") && node.contains(key)) reject(path, where + ": it has both a matrix and a " + key);
  }
  if (node.contains("matrix")) return affine(path, given("matrix", std::vector<double>(16)), where + ".matrix");
  const std::vector<double> translation = given("translation", {0, 0, 0});
  const Eigen::Quaterniond turn = unit_quaternion(path, given("rotation", {0, 0, 0, 1}), where + ".rotation");
  const std::vector<double> scale = given("scale", {1, 1, 1});
  return Eigen::Translation3d(translation[0], translation[1], translation[2]) * turn *
         Eigen::Scaling(scale[0], scale[1], scale[2]);
}

}  // namespace glissade::geometry
