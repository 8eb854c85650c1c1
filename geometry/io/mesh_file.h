#pragma once

/// Mesh files: opening and reading them, and messages about them.

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace glissade::geometry {

/// A file to read. Its size is known before its content is read, so that a header can be compared with it first.
class MeshFile {
 public:
  /// Largest size in bytes, 16 GiB. The shortest vertex of a text takes 8 bytes, so no larger file has vertices that
  /// an index of 31 bits can number.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 34U;

  /// Opens the file. Throws std::invalid_argument for a file that is missing, not regular, unreadable, empty or larger
  /// than `kMostBytes`.
  explicit MeshFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// The first `length` bytes, or all if the file is shorter. Throws std::invalid_argument when they cannot be read.
  std::string beginning(std::uint64_t length);
  std::string content() { return beginning(size_); }

 private:
  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  std::ifstream stream_;
};

/// The text as one line, shortened and without control characters: names from a file may have any length and content.
std::string one_line(const std::string& text);

/// Throws std::invalid_argument: `path` and `what` in one line, shortened and without control characters.
[[noreturn]] void reject(const std::filesystem::path& path, const std::string& what);

/// Whether the number is finite and within ±1e9.
inline bool is_coordinate(double value) {
  constexpr double kLargest = 1e9;
  return std::abs(value) <= kLargest;
}

/// Rejects a number that is not a coordinate; `where` names the line or element.
[[noreturn]] void reject_coordinate(const std::filesystem::path& path, const std::string& where, double value);

}  // namespace glissade::geometry
