#pragma once

/// A glTF document: safe access to its entries. All functions throw std::invalid_argument for an entry with an invalid
/// value, naming the file and the entry, and exceptions of the JSON library for an entry that is missing or of the
/// wrong type.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/mesh_warnings.h"

namespace glissade::geometry {

/// The JSON of a document. Throws std::invalid_argument for text that is not JSON or nested too deeply.
nlohmann::json parsed_gltf(const std::filesystem::path& path, std::string_view text);

/// A parsed document of version 2, and the warnings of its import. Path and JSON must outlive it.
class GltfDocument {
 public:
  GltfDocument(const std::filesystem::path& path, const nlohmann::json& root, MeshWarnings warnings);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::json& root() const { return root_; }
  MeshWarnings& warnings() { return warnings_; }

  /// The number of entries in the array `key` of the document; 0 if it has none.
  std::size_t size(const char* key) const { return root_.contains(key) ? root_.at(key).size() : 0; }

  /// A number that must be the number of an entry of the array `key`.
  std::size_t index(const char* key, const nlohmann::json& number) const;

  /// The entry with that number.
  const nlohmann::json& entry(const char* key, const nlohmann::json& number) const {
    return root_.at(key).at(index(key, number));
  }

  /// The natural number `key` of an object, or `otherwise` if it has none; `where` names the object in messages.
  std::uint64_t natural_or(const nlohmann::json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where) const;

  /// Counts `number` more elements that the import reads or places: points, corners and others. A small file may refer
  /// to the same ones again and again, so more than 200 million are rejected; `where` names what they belong to. So
  /// many take a few gigabytes.
  void count(std::uint64_t number, const std::string& where);

 private:
  const std::filesystem::path& path_;
  const nlohmann::json& root_;
  MeshWarnings warnings_;
  std::uint64_t counted_ = 0;
};

}  // namespace glissade::geometry
