#pragma once

/// Sentences to the user.

#include <string>
#include <string_view>

#include <unistd.h>

namespace glissade::apps {

/// Writes a line to standard error, or to another descriptor. Where a full pipe or a stopped terminal would make the
/// program wait, the line is left out: a program that holds a hand must go on and hear Ctrl-C.
void say(std::string_view line, int descriptor = STDERR_FILENO);

/// Writes a warning as one line to standard error, before something runs.
void warn(const std::string& sentence);

}  // namespace glissade::apps
