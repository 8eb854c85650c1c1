#pragma once

/// Tables of an event log, for other tools.

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::apps {

struct LogTable {
  std::string file;
  std::int64_t rows = 0;
};

/// Writes ticks.csv, parts.csv, hands.csv and gloves.csv into the folder, which is made if there is none; a table
/// without rows is left out. docs/file_formats.md has the columns. Reads up to the first damage, and leaves out events
/// that cannot be read; of either, `damage` then tells. Ignores channels that it does not know. Shows a progress bar.
/// Throws std::invalid_argument, naming file or folder, when the log cannot be read or a table cannot be created, and
/// std::runtime_error when not everything could be written.
std::vector<LogTable> write_log_tables(const std::string& log_path, const std::string& folder, std::string& damage);

}  // namespace glissade::apps
