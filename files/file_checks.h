#pragma once

/// Checks of input and output files before they are opened, the same for all commands. The functions throw
/// std::invalid_argument, naming the file. docs/command_line.md has the rules. Thread-safe.

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace glissade::files {

/// Call this function before a file is read. The file must be a regular file. Later checks reject it as an output.
void check_input(const std::string& path);

/// Call this function before a file is written. The folder of the file must exist. The file must not be a folder or an
/// input, not even through links. It may be a device or a pipe.
void check_output(const std::string& path);

/// Opens a file for writing after `check_output`. If the file is a pipe without a reader, waits for a reader.
std::ofstream open_output(const std::string& path);

/// Call this function before a run that is recorded. Like `check_output`; in addition, the file must be writable, and
/// must not be a pipe, because a run cannot wait for a reader. The file may exist already only if `overwrites` is true.
void check_recording(const std::string& path, bool overwrites);

/// Checks that all files are different. Each pair has an option and the file named by this option. Empty names are left
/// out, and "-" is standard output.
void check_distinct(const std::vector<std::pair<std::string, std::string>>& outputs);

}  // namespace glissade::files
