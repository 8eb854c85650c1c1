#include "io/mesh_validation.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace glissade::geometry {

void reject(const std::filesystem::path& path, const std::string& what) {
  // Names from the file may have any length and content, but the message is one line.
  constexpr std::size_t kLongest = 1000;
  std::string line = what.size() > kLongest ? what.substr(0, kLongest) + " ..." : what;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '?');
  throw std::invalid_argument(path.string() + ": " + line + (line.ends_with('.') ? "" : "."));
}

void check_coordinate(const std::filesystem::path& path, const std::string& where, double value) {
  constexpr double kLargest = 1e9;
  if (std::isfinite(value) && std::abs(value) <= kLargest) return;
  std::ostringstream message;
  message << where << ": the coordinate " << value << (std::isfinite(value) ? " is beyond 1e9" : " is not finite");
  reject(path, message.str());
}

std::string file_content(const std::filesystem::path& path) {
  if (path.empty()) throw std::invalid_argument("The name of the mesh file is empty.");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) reject(path, "There is no such file");
  if (std::filesystem::is_directory(status)) reject(path, "This is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) reject(path, "This is not a regular file");
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad()) reject(path, "The file cannot be read");
  if (content.empty()) reject(path, "The file is empty");
  return content;
}

}  // namespace glissade::geometry
