#pragma once

/// The buffers of a glTF document.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The content of each buffer, from data URIs, from files next to the document, or `binary`, the chunk of a GLB. Throws
/// std::invalid_argument for what is missing, malformed or shorter than its byteLength, and exceptions of the JSON
/// library for entries that are missing.
std::vector<std::string> gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                                      std::string_view binary);

}  // namespace glissade::geometry
