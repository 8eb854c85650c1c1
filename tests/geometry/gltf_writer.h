#pragma once

// glTF documents written by code.

#include <cstddef>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "mesh_files.h"

namespace glissade::geometry {

inline std::string base64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (unsigned k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[(bits >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

/// A document that grows: its JSON, and the content of its first buffer.
class GltfWriter {
 public:
  GltfWriter() { root = {{"asset", {{"version", "2.0"}}}, {"nodes", nlohmann::json::array()}}; }

  /// Adds a view of `bytes`; `stride` is 0 where its elements follow each other closely.
  std::size_t add_view(const std::string& bytes, int stride = 0) {
    nlohmann::json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    root["bufferViews"].push_back(view);
    binary += bytes + std::string((4 - bytes.size() % 4) % 4, '\0');
    return root["bufferViews"].size() - 1;
  }

  /// Adds an accessor without values, which are zeros.
  std::size_t add_zeros(int component, const char* type, std::size_t count) {
    root["accessors"].push_back({{"componentType", component}, {"count", count}, {"type", type}});
    return root["accessors"].size() - 1;
  }

  /// Adds the accessor of `bytes`, which are `count` elements.
  std::size_t add_accessor(const std::string& bytes, int component, const char* type, std::size_t count,
                           int stride = 0) {
    const std::size_t view = add_view(bytes, stride);
    const std::size_t accessor = add_zeros(component, type, count);
    root["accessors"][accessor]["bufferView"] = view;
    return accessor;
  }

  void add_mesh(const nlohmann::json& primitives) { root["meshes"].push_back({{"primitives", primitives}}); }
  void add_node(const nlohmann::json& node) { root["nodes"].push_back(node); }

  /// The document with its buffer as a data URI.
  std::string gltf() const { return with_buffer("data:application/octet-stream;base64," + base64(binary)).dump(); }
  std::string glb() const { return geometry::glb(with_buffer("").dump(), binary); }

  nlohmann::json root;
  std::string binary;

 private:
  nlohmann::json with_buffer(const std::string& uri) const {
    nlohmann::json result = root;
    nlohmann::json& buffer = result["buffers"][0];
    buffer["byteLength"] = binary.size();
    if (!uri.empty()) buffer["uri"] = uri;
    return result;
  }
};

}  // namespace glissade::geometry
