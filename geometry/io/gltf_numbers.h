#pragma once

/// Natural numbers in glTF documents.

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "io/mesh_file.h"

namespace glissade::geometry {

/// The natural number `key` of `object`; any other value is rejected. The JSON library's own conversion also accepts
/// fractions, booleans and -1, and is undefined for 1e99. `where` names the object in messages. Throws an exception of
/// the JSON library for a missing entry.
inline std::uint64_t natural_at(const std::filesystem::path& path, const nlohmann::json& object, const char* key,
                                const std::string& where) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_number_unsigned()) {
    reject(path, where + "." + key + " is of the wrong kind: " + value.dump() + " is not a whole number");
  }
  return value.get<std::uint64_t>();
}

}  // namespace glissade::geometry
