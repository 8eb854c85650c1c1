#pragma once

/// Whole numbers of glTF documents.

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "io/mesh_validation.h"

namespace glissade::geometry {

/// The entry `key` of `object`, which must be a whole number from 0: the JSON library's own conversion also takes
/// fractions, truth values and -1, and is undefined for 1e99. `where` is the object. An entry that is missing comes as
/// an exception of the JSON library.
inline std::uint64_t natural_at(const std::filesystem::path& path, const nlohmann::json& object, const char* key,
                                const std::string& where) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_number_unsigned()) {
    reject(path, where + "." + key + " is of the wrong kind: " + value.dump() + " is not a whole number");
  }
  return value.get<std::uint64_t>();
}

}  // namespace glissade::geometry
