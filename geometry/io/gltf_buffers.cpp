#include "io/gltf_buffers.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

/// The bytes of a base64 text, which may be broken into lines; rejects a text with any other character.
std::string decoded_base64(const std::filesystem::path& path, const std::string& where, std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::string_view kWhiteSpace = " \t\r\n\f";
  text = text.substr(0, text.find_last_not_of("= \t\r\n\f") + 1);
  std::string bytes;
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    if (kWhiteSpace.find(c) != std::string_view::npos) continue;
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

/// The path of a buffer's file. Names are percent-encoded, but some programs write them as they are.
std::filesystem::path file_of(const std::filesystem::path& path, const std::string& where, const std::string& uri) {
  const std::string decoded = decoded_percent(uri);
  for (const std::string& name : {decoded, uri}) {
    if (leaves_folder(name)) {
      reject(path, where + ": only files in the folder of the document and below are read, not '" + uri + "'");
    }
  }
  std::error_code ignored;
  const std::filesystem::path as_it_is = path.parent_path() / uri;
  const std::filesystem::path result = path.parent_path() / decoded;
  return std::filesystem::exists(result, ignored) || !std::filesystem::exists(as_it_is, ignored) ? result : as_it_is;
}

std::string file_buffer(const std::filesystem::path& path, const std::string& where, const std::string& uri,
                        std::uint64_t length) {
  std::uint64_t size = 0;
  const std::filesystem::path name = file_of(path, where, uri);
  try {
    MeshFile file(name);
    if (file.size() >= length) return file.beginning(length);
    size = file.size();
  } catch (const std::invalid_argument& error) {
    reject(path, where + ": " + error.what());
  }
  reject_short(path, where, size, length);
}

/// The content of a data URI (RFC 2397), in base64 or percent-encoded.
std::string data_buffer(const std::filesystem::path& path, const std::string& where, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) reject(path, where + ": its data URI has no comma, after which its data begins");
  const std::string data = decoded_percent(uri.substr(comma + 1));
  return uri.substr(0, comma).ends_with(";base64") ? decoded_base64(path, where, data) : data;
}

}  // namespace

GltfBuffers::GltfBuffers(const std::filesystem::path& path, const nlohmann::json& root, std::string_view binary)
    : path_(path), root_(root), binary_(binary), contents_(root.contains("buffers") ? root.at("buffers").size() : 0) {}

bool GltfBuffers::has_content(std::size_t index) const {
  return root_.at("buffers").at(index).contains("uri") || (index == 0 && !binary_.empty());
}

std::string_view GltfBuffers::content(std::size_t index) {
  if (contents_.at(index)) return *contents_[index];
  const nlohmann::json& buffer = root_.at("buffers").at(index);
  const std::string where = "buffers[" + std::to_string(index) + "]";
  const std::uint64_t length = natural_at(path_, buffer, "byteLength", where);
  if (!buffer.contains("uri")) {  // only the first buffer may be the binary chunk
    const std::string_view content = index == 0 ? binary_ : std::string_view();
    if (content.size() < length) reject_short(path_, where, content.size(), length);
    return content.substr(0, length);
  }
  if (length > MeshFile::kMostBytes - total_) reject(path_, where + ": up to here the buffers have more than 16 GiB");
  total_ += length;
  const std::string uri = buffer.at("uri").get<std::string>();
  std::string content =
      uri.starts_with("data:") ? data_buffer(path_, where, uri) : file_buffer(path_, where, uri, length);
  if (content.size() < length) reject_short(path_, where, content.size(), length);
  content.resize(length);
  return contents_[index].emplace(std::move(content));
}

}  // namespace glissade::geometry
