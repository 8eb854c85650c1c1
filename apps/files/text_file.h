#pragma once

/// Text files as a whole, or to be read in pieces.

#include <cstdint>
#include <fstream>
#include <string>

namespace glissade::apps {

/// Longer than any trajectory of a day.
inline constexpr std::uintmax_t kLargestTextFile = std::uintmax_t{1} << 34U;

/// The file, open for reading. Throws std::invalid_argument, naming the file, when it is missing, not a regular file,
/// longer than `max_bytes` or cannot be opened.
std::ifstream open_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

/// The file's bytes. Throws as `open_text_file`, and when it cannot be read.
std::string read_text_file(const std::string& path, std::uintmax_t max_bytes = kLargestTextFile);

}  // namespace glissade::apps
