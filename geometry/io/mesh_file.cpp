#include "io/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace glissade::geometry {

MeshFile::MeshFile(const std::filesystem::path& path) : path_(path) {
  if (path.empty()) throw std::invalid_argument("The name of the mesh file is empty.");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::invalid_argument(path.string() + ": there is no such file");
  if (std::filesystem::is_directory(status)) reject(path, "this is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) reject(path, "this is not a regular file");
  size_ = std::filesystem::file_size(path, error);
  if (error) reject(path, "the file cannot be read");
  if (size_ == 0) reject(path, "the file is empty");
  if (size_ > kMostBytes) reject(path, "the file is larger than 16 GiB, it has " + std::to_string(size_) + " bytes");
  stream_.open(path, std::ios::binary);
  if (!stream_.is_open()) reject(path, "the file cannot be read");
}

std::string MeshFile::beginning(std::uint64_t length) {
  std::string bytes(std::min(length, size_), '\0');
  stream_.seekg(0);
  stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) reject(path_, "the file cannot be read");
  return bytes;
}

std::string one_line(const std::string& text) {
  constexpr std::size_t kLongest = 1000;
  std::string line = text.size() > kLongest ? text.substr(0, kLongest) + " ..." : text;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '?');
  return line;
}

void reject(const std::filesystem::path& path, const std::string& what) {
  const std::string line = one_line(what);
  throw std::invalid_argument(path.string() + ": " + line + (line.ends_with('.') ? "" : "."));
}

void reject_coordinate(const std::filesystem::path& path, const std::string& where, double value) {
  std::ostringstream message;
  message << where << ": the coordinate " << value << (std::isfinite(value) ? " is beyond 1e9" : " is not finite");
  reject(path, message.str());
}

}  // namespace glissade::geometry
