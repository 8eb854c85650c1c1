#include "io/gltf_placement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "io/mesh_validation.h"

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
    check_coordinate(path, where, number);
  }
  return result;
}

/// `matrix` is given column by column.
void check_last_row(const std::filesystem::path& path, const json& matrix, const std::string& where) {
  const json row{matrix.at(3), matrix.at(7), matrix.at(11), matrix.at(15)};
  if (row != json{0.0, 0.0, 0.0, 1.0}) reject(path, where + ": its last row is " + row.dump() + ", not 0, 0, 0, 1");
}

/// A deviation from unit length by rounding is removed; any other would scale the mesh, and is rejected.
std::vector<double> unit_quaternion(const std::filesystem::path& path, const json& given, const std::string& where) {
  auto xyzw = given.get<std::vector<double>>();
  const double length = std::sqrt(std::inner_product(xyzw.begin(), xyzw.end(), xyzw.begin(), 0.0));
  if (std::abs(length - 1.0) > 1e-3) {
    reject(path, where + ": the quaternion " + given.dump() + " has the length " + json(length).dump() + ", not 1");
  }
  for (double& number : xyzw) {
    number /= length;
  }
  return xyzw;
}

}  // namespace

json copied_placement(const std::filesystem::path& path, const json& node, const std::string& where) {
  json copy = json::object();
  for (const auto& [key, length] :
       {std::pair<const char*, std::size_t>{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}) {
    if (!node.contains(key)) continue;
    if (copy.contains("matrix")) reject(path, where + ": it has both a matrix and a " + key);
    copy[key] = numbers(path, node.at(key), length, where + "." + key);
  }
  if (copy.contains("matrix")) check_last_row(path, copy.at("matrix"), where + ".matrix");
  if (copy.contains("rotation")) copy["rotation"] = unit_quaternion(path, copy.at("rotation"), where + ".rotation");
  return copy;
}

}  // namespace glissade::geometry
