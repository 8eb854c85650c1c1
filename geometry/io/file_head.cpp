#include "io/file_head.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include <glissade/base/byte_order.h>

#include "io/mesh_validation.h"

namespace glissade::geometry {
namespace {

constexpr std::uintmax_t kLarge = 1U << 20U;
constexpr std::size_t kHeadSize = 4096;

void check_size(const std::filesystem::path& path, std::uintmax_t size, std::uintmax_t size_of_header) {
  if (size == size_of_header) return;
  reject(path,
         "The file has " + std::to_string(size) + " bytes, but " + std::to_string(size_of_header) + " by its header");
}

}  // namespace

void check_head(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size < kLarge) return;
  std::string head(kHeadSize, '\0');
  if (!std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()))) return;

  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t zero = head.find('\0');
  if (extension == ".stl" && zero != std::string::npos) {
    check_size(path, size, 84 + std::uintmax_t{50} * base::number_at<std::uint32_t>(head, 80));
  }
  if (extension == ".glb") check_size(path, size, base::number_at<std::uint32_t>(head, 8));
  if (extension == ".ply" && !head.starts_with("ply")) reject(path, "A PLY file begins with 'ply'");
  if ((extension == ".obj" || extension == ".gltf") && zero != std::string::npos) {
    reject(path, "This is not text: byte " + std::to_string(zero) + " is zero");
  }
}

}  // namespace glissade::geometry
