#include "io/gltf_buffers.h"

#include <charconv>
#include <cstdint>
#include <stdexcept>

#include "io/gltf_numbers.h"
#include "io/mesh_validation.h"

namespace glissade::geometry {
namespace {

/// The bytes of a base64 text; rejects a text with any other character.
std::string decoded_base64(const std::filesystem::path& path, const std::string& where, std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (text.ends_with('=')) {
    text.remove_suffix(1);
  }
  std::string bytes;
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) reject(path, where + ": its data is not base64");
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes += static_cast<char>((bits >> static_cast<unsigned>(bit_count)) & 0xFFU);
    }
  }
  return bytes;
}

/// `text` with its %XX sequences replaced.
std::string decoded_percent(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr == text.data() + i + 3) {
      result += static_cast<char>(value);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string buffer_content(const std::filesystem::path& path, const std::string& where, const std::string& uri) {
  if (uri.starts_with("data:")) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (mark == std::string::npos) reject(path, where + ": its data is not base64");
    return decoded_base64(path, where, std::string_view(uri).substr(mark + kMark.size()));
  }
  if (uri.find("://") != std::string::npos) reject(path, where + ": only files are read, not '" + uri + "'");
  const std::filesystem::path file = std::filesystem::path(decoded_percent(uri)).lexically_normal();
  if (file.is_absolute() || (!file.empty() && *file.begin() == "..")) {
    reject(path, where + ": '" + uri + "' is not in the folder of this file");
  }
  try {
    return file_content(path.parent_path() / file);
  } catch (const std::invalid_argument& error) {
    reject(path, where + ": " + error.what());
  }
}

}  // namespace

std::vector<std::string> gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                                      std::string_view binary) {
  std::vector<std::string> contents;
  if (!document.contains("buffers")) return contents;
  for (const nlohmann::json& buffer : document.at("buffers")) {
    const std::string where = "buffers[" + std::to_string(contents.size()) + "]";
    const std::uint64_t length = natural_at(path, buffer, "byteLength", where);
    // Only the first buffer may be the binary chunk.
    std::string content = buffer.contains("uri") ? buffer_content(path, where, buffer.at("uri").get<std::string>())
                          : contents.empty()     ? std::string(binary)
                                                 : std::string();
    if (content.size() < length) {
      reject(path, where + ": it has " + std::to_string(content.size()) + " bytes, but should have " +
                       std::to_string(length));
    }
    content.resize(length);
    contents.push_back(std::move(content));
  }
  return contents;
}

}  // namespace glissade::geometry
