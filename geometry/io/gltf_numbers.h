#pragma once

/// Numbers in the JSON of glTF documents.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The natural number `key` of `object`; any other value is rejected. The JSON library's own conversion also accepts
/// fractions, booleans and -1, and is undefined for 1e99. `where` names the object in messages. Throws an exception of
/// the JSON library for a missing entry.
std::uint64_t natural_at(const std::filesystem::path& path, const nlohmann::json& object, const char* key,
                         const std::string& where);

/// The numbers of an array, each within ±1e9; any other value is rejected. `where` names the array in messages.
std::vector<double> number_array(const std::filesystem::path& path, const nlohmann::json& value,
                                 const std::string& where);

}  // namespace glissade::geometry
