#pragma once

/// What a run reads and what it writes, checked in one way for all commands before a file is opened. The functions
/// throw std::invalid_argument, naming the file. docs/command_line.md has the rules. Thread-safe.

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace glissade::files {

/// Before a file is read: it must be a regular file. Notes it, so that no output takes its place.
void check_input(const std::string& path);

/// Before a file is written: its folder must be there, and it must be no folder and no input, whatever links lead to
/// it. A device or a pipe may be written.
void check_output(const std::string& path);

/// The file after `check_output`, open for writing. If the file is a pipe without a reader, waits for the reader.
std::ofstream open_output(const std::string& path);

/// Before a run whose recording is to be written. As `check_output`; the file must be no pipe, because a run cannot
/// wait for a reader, and must be writable. An older file may be there only if `overwrites`.
void check_recording(const std::string& path, bool overwrites);

/// Options and the files that they name, which must all be different. Empty names are left out, and "-" is the standard
/// output.
void check_distinct(const std::vector<std::pair<std::string, std::string>>& outputs);

}  // namespace glissade::files
