#include "io/glb_container.h"

#include <cstdint>

#include <glissade/base/byte_order.h>

namespace glissade::geometry {
namespace {

constexpr WarningKind kBytesAfterTheEnd{"byte after the end that the header names is ignored",
                                        "bytes after the end that the header names are ignored"};

}  // namespace

std::string glb_content(MeshFile& file, MeshWarnings& warnings) {
  const std::string header = file.beginning(20);
  if (header.size() < 20) reject(file.path(), "a GLB file begins with 'glTF' and a header of 20 bytes");
  if (base::number_at<std::uint32_t>(header, 4) != 2) reject(file.path(), "the version in the header is not 2");
  const std::uint32_t length = base::number_at<std::uint32_t>(header, 8);
  if (length > file.size()) {
    reject(file.path(), "the file is truncated: it has " + std::to_string(file.size()) + " bytes, its header says " +
                            std::to_string(length));
  }
  if (length < file.size()) {
    warnings.add(kBytesAfterTheEnd, "byte " + std::to_string(length), static_cast<std::int64_t>(file.size() - length));
  }
  return file.beginning(length);
}

GlbChunks glb_chunks(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::size_t kPadding = 3;  // some programs do not count it as part of the last chunk
  GlbChunks result;
  for (std::size_t begin = 12; begin + kPadding < bytes.size();) {
    const std::string where = "the chunk at byte " + std::to_string(begin);
    if (bytes.size() - begin < 8) reject(path, where + " is truncated");
    const std::uint32_t size = base::number_at<std::uint32_t>(bytes, begin);
    const std::string_view kind = bytes.substr(begin + 4, 4);
    if (size > bytes.size() - begin - 8) reject(path, where + " is truncated");
    const std::string_view content = bytes.substr(begin + 8, size);
    if (kind == "JSON" && result.text.empty()) result.text = content;
    if (kind == std::string_view("BIN\0", 4) && result.binary.empty()) result.binary = content;
    begin += 8 + size;
  }
  result.text = result.text.substr(0, result.text.find_last_not_of('\0') + 1);  // padding that should have been spaces
  return result;
}

}  // namespace glissade::geometry
