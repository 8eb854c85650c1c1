#pragma once

/// A GLB file in the making: a document and one binary chunk.

#include <cstddef>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

class GlbWriter {
 public:
  /// The document; accessors, their views and the buffer are added by the functions below.
  nlohmann::json& document() { return document_; }

  /// Appends elements to the binary chunk; returns the number of their accessor.
  std::size_t add_accessor(const std::string& bytes, std::uint64_t component, const char* type, std::size_t count);

  /// The bytes of the whole file.
  std::string written();

 private:
  nlohmann::json document_ = nlohmann::json::object();
  std::string binary_;
};

}  // namespace glissade::geometry
