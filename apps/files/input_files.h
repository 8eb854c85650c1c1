#pragma once

/// What this process has read, so that no output takes its place.

#include <string>

namespace glissade::apps {

/// Notes a file that is read. Thread-safe.
void note_input(const std::string& path);

/// Throws std::invalid_argument, naming the file, if it has been read. Thread-safe.
void refuse_input(const std::string& path);

}  // namespace glissade::apps
