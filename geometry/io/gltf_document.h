#pragma once

/// A glTF document with the content of its buffers: safe access to its entries and to the elements of its accessors.
/// Everything throws std::invalid_argument for an entry that makes no sense, naming the file and the entry, and
/// exceptions of the JSON library for one that is missing or of the wrong kind.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The values of componentType.
inline constexpr std::uint64_t kGltfByte = 5121;
inline constexpr std::uint64_t kGltfShort = 5123;
inline constexpr std::uint64_t kGltfInt = 5125;
inline constexpr std::uint64_t kGltfFloat = 5126;

/// The JSON of a document. Throws std::invalid_argument for text that is not JSON or nested too deeply.
nlohmann::json parsed_gltf(const std::filesystem::path& path, std::string_view text);

/// Path and JSON must outlive it.
class GltfDocument {
 public:
  /// `binary` is the chunk of a GLB. Reads the buffers that lie in files of their own.
  GltfDocument(const std::filesystem::path& path, const nlohmann::json& root, std::string_view binary);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::json& root() const { return root_; }

  /// Rejects other versions than 2, and extensions without which the geometry cannot be read.
  void check_version() const;

  /// Entry `index` of the array `key` of the document.
  const nlohmann::json& entry(const char* key, const nlohmann::json& index) const;

  /// The whole number `key` of an object; `where` is the object.
  std::uint64_t natural_or(const nlohmann::json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where) const;

  /// The componentType of the accessor `index`.
  std::uint64_t component(const nlohmann::json& index) const;

  /// The elements of an accessor: where each begins within its buffer.
  struct Elements {
    std::string_view bytes;
    std::size_t begin;
    std::size_t stride;
    std::size_t count;
  };
  Elements elements(const nlohmann::json& index, const std::string& type, std::size_t element_size) const;

 private:
  const std::filesystem::path& path_;
  const nlohmann::json& root_;
  std::vector<std::string> buffers_;
};

}  // namespace glissade::geometry
