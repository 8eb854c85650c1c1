#pragma once

/// Reads text files, as a whole or in pieces, and writes them.

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace glissade::files {

/// The largest text file that is read by default (bytes). A trajectory of a day is smaller.
inline constexpr std::uintmax_t kLargestTextFile = std::uintmax_t{1} << 34U;

/// Opens the file for reading. Throws std::invalid_argument, naming the file, if the file is missing, is not a regular
/// file, is longer than `max_bytes`, or cannot be opened.
std::ifstream open_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

struct TextFile {
  std::string path;
  std::string text;
};

/// The file's bytes. Throws what `open_text_file` throws, and std::invalid_argument if the file cannot be read.
std::string read_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

/// Writes files. An existing file with the same content is kept. If an existing file has other content, nothing is
/// written. Throws std::invalid_argument for such a file and for an existing file that cannot be read. Also throws what
/// `open_output` throws, and std::runtime_error if not everything could be written.
void write_new_files(const std::vector<TextFile>& files);

}  // namespace glissade::files
