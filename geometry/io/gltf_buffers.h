#pragma once

/// The buffers of a glTF document.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::geometry {

/// The content of each buffer: from a data URI, from a file next to the document, or from `binary`, the binary chunk of
/// a GLB. A buffer is read when it is needed first: one that only holds images may be missing. Path, JSON and `binary`
/// must outlive it.
class GltfBuffers {
 public:
  GltfBuffers(const std::filesystem::path& path, const nlohmann::json& root, std::string_view binary);

  /// Whether the document says where the content is. A buffer without content may be a placeholder for what an
  /// extension compresses.
  bool has_content(std::size_t index) const;

  /// The content of buffer `index`, which must exist. Throws std::invalid_argument for a file that is missing or
  /// outside the document's folder, for content that is malformed or shorter than its byteLength, and for more than 16
  /// GiB in all. Throws an exception of the JSON library for a missing entry.
  std::string_view content(std::size_t index);

 private:
  const std::filesystem::path& path_;
  const nlohmann::json& root_;
  std::string_view binary_;
  std::vector<std::optional<std::string>> contents_;  // those read so far, but for `binary_`
  std::uint64_t total_ = 0;
};

}  // namespace glissade::geometry
