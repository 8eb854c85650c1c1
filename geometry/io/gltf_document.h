#pragma once

/// A glTF document with the content of its buffers: safe access to its entries and to the elements of its accessors.
/// All functions throw std::invalid_argument for an entry with an invalid value, naming the file and the entry, and
/// exceptions of the JSON library for an entry that is missing or of the wrong type.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// Values of componentType.
inline constexpr std::uint64_t kGltfInt8 = 5120;
inline constexpr std::uint64_t kGltfUint8 = 5121;
inline constexpr std::uint64_t kGltfInt16 = 5122;
inline constexpr std::uint64_t kGltfUint16 = 5123;
inline constexpr std::uint64_t kGltfUint32 = 5125;
inline constexpr std::uint64_t kGltfFloat = 5126;

/// The JSON of a document. Throws std::invalid_argument for text that is not JSON or nested too deeply.
nlohmann::json parsed_gltf(const std::filesystem::path& path, std::string_view text);

/// A parsed document with the content of its buffers. Path and JSON must outlive it.
class GltfDocument {
 public:
  /// `binary` is the binary chunk of a GLB. Reads buffers in separate files.
  GltfDocument(const std::filesystem::path& path, const nlohmann::json& root, std::string_view binary);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::json& root() const { return root_; }

  /// Rejects versions other than 2, and required extensions that may change the geometry.
  void check_version() const;

  /// Whether positions may be integers of one or two bytes: the document requires KHR_mesh_quantization.
  bool allows_quantized_positions() const;

  /// Entry `index` of the array `key` of the document.
  const nlohmann::json& entry(const char* key, const nlohmann::json& index) const;

  /// The natural number `key` of an object, or `otherwise` if it has none; `where` names the object in messages.
  std::uint64_t natural_or(const nlohmann::json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where) const;

  /// The componentType of the accessor `index`.
  std::uint64_t component(const nlohmann::json& index) const;

  /// Whether the integers of the accessor `index` stand for fractions of the largest one.
  bool is_normalized(const nlohmann::json& index) const;

  /// The elements of an accessor: element i begins at byte `begin` + i · `stride` of its buffer `bytes`.
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
