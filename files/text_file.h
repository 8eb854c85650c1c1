#pragma once

/// Text files as a whole, or to be read in pieces.

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace glissade::files {

/// Longer than any trajectory of a day.
inline constexpr std::uintmax_t kLargestTextFile = std::uintmax_t{1} << 34U;

/// The file, open for reading. Throws std::invalid_argument, naming the file, when it is missing, not a regular file,
/// longer than `max_bytes` or cannot be opened.
std::ifstream open_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

struct TextFile {
  std::string path;
  std::string text;
};

/// The file's bytes. Throws as `open_text_file`, and when it cannot be read.
std::string read_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

/// Writes files. One that is there already is kept if it has the same content; if one has another, nothing is written.
/// Throws std::invalid_argument for such a file, for one that cannot be read, and as `open_output`; std::runtime_error
/// when not everything could be written.
void write_new_files(const std::vector<TextFile>& files);

}  // namespace glissade::files
