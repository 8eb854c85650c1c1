#include "io/gltf_numbers.h"

#include <algorithm>

#include "io/mesh_file.h"

namespace glissade::geometry {

using nlohmann::json;

std::uint64_t natural_at(const std::filesystem::path& path, const json& object, const char* key,
                         const std::string& where) {
  const json& value = object.at(key);
  if (!value.is_number_unsigned()) {
    reject(path, where + "." + key + " is of the wrong kind: " + value.dump() + " is not a whole number");
  }
  return value.get<std::uint64_t>();
}

std::vector<double> number_array(const std::filesystem::path& path, const json& value, const std::string& where) {
  // The JSON library's own conversion accepts booleans too.
  const bool are_numbers = std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
  if (!value.is_array() || !are_numbers) reject(path, where + " must be an array of numbers");
  auto result = value.get<std::vector<double>>();
  for (const double number : result) {
    if (!is_coordinate(number)) reject_coordinate(path, where, number);
  }
  return result;
}

}  // namespace glissade::geometry
