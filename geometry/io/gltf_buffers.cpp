#include "io/gltf_buffers.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <stdexcept>

#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

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

/// Whether the decoded URI may name a file outside the folder of the document: it is absolute, has a scheme or a drive,
/// or goes up.
bool leaves_folder(std::string_view name) {
  if (name.starts_with('/') || name.starts_with('\\')) return true;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find_first_of("/\\", begin), name.size());
    const std::string_view part = name.substr(begin, end - begin);
    if (part == ".." || (begin == 0 && part.find(':') != std::string_view::npos)) return true;
    begin = end + 1;
  }
  return name.find('\0') != std::string_view::npos;  // the operating system would read less of the name
}

[[noreturn]] void reject_short(const std::filesystem::path& path, const std::string& where, std::uint64_t size,
                               std::uint64_t length) {
  reject(path, where + ": it has " + std::to_string(size) + " bytes, but should have " + std::to_string(length));
}

std::string file_buffer(const std::filesystem::path& path, const std::string& where, const std::string& uri,
                        std::uint64_t length) {
  const std::string name = decoded_percent(uri);
  if (leaves_folder(name)) {
    reject(path, where + ": only files in the folder of the document and below are read, not '" + uri + "'");
  }
  std::uint64_t size = 0;
  try {
    MeshFile file(path.parent_path() / name);
    if (file.size() >= length) return file.beginning(length);
    size = file.size();
  } catch (const std::invalid_argument& error) {
    reject(path, where + ": " + error.what());
  }
  reject_short(path, where, size, length);
}

std::string data_buffer(const std::filesystem::path& path, const std::string& where, const std::string& uri) {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  if (mark == std::string::npos) reject(path, where + ": its data is not base64");
  return decoded_base64(path, where, std::string_view(uri).substr(mark + kMark.size()));
}

}  // namespace

std::vector<std::string> gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                                      std::string_view binary) {
  std::vector<std::string> contents;
  if (!document.contains("buffers")) return contents;
  std::uint64_t total = 0;
  for (const nlohmann::json& buffer : document.at("buffers")) {
    const std::string where = "buffers[" + std::to_string(contents.size()) + "]";
    const std::uint64_t length = natural_at(path, buffer, "byteLength", where);
    if (length > MeshFile::kMostBytes - total) reject(path, where + ": up to here the buffers have more than 16 GiB");
    total += length;
    const std::string uri = buffer.contains("uri") ? buffer.at("uri").get<std::string>() : std::string();
    std::string& content = contents.emplace_back();
    if (uri.starts_with("data:")) {
      content = data_buffer(path, where, uri);
    } else if (buffer.contains("uri")) {
      content = file_buffer(path, where, uri, length);
    } else if (contents.size() == 1) {  // only the first buffer may be the binary chunk
      content = binary.substr(0, length);
    }
    if (content.size() < length) reject_short(path, where, content.size(), length);
    content.resize(length);
  }
  return contents;
}

}  // namespace glissade::geometry
