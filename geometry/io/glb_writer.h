#pragma once

/// Writer of a GLB file: a JSON document and one binary chunk.

#include <cstddef>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

class GlbWriter {
 public:
  /// The JSON document. The functions below add accessors, their views and the buffer.
  nlohmann::json& document() { return document_; }

  /// Appends elements to the binary chunk; returns the index of their accessor. `component` and `type` are those of
  /// glTF.
  std::size_t add_accessor(const std::string& bytes, std::uint64_t component, const char* type, std::size_t count);

  /// The bytes of the whole file.
  std::string written();

 private:
  nlohmann::json document_ = nlohmann::json::object();
  std::string binary_;
};

}  // namespace glissade::geometry
