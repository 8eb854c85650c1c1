#pragma once

/// The buffers of a glTF document.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The content of each buffer: from a data URI, from a file next to the document, or from `binary`, the binary chunk of
/// a GLB. Throws std::invalid_argument for a file that is missing or outside the document's folder, for content that is
/// malformed or shorter than its byteLength, and for more than 16 GiB. Throws an exception of the JSON library for a
/// missing entry.
std::vector<std::string> gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                                      std::string_view binary);

}  // namespace glissade::geometry
