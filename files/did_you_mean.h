#pragma once

/// Help for a name that was mistyped.

#include <string>
#include <string_view>
#include <vector>

namespace glissade::files {

/// " (did you mean 'name'?)" with the known name that is the fewest slips of the keyboard away from `word`; empty if
/// all are too far away. A slip is a character too many, too few or wrong, or two that changed places.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace glissade::files
