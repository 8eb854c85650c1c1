#pragma once

/// Help for a name that was mistyped.

#include <string>
#include <string_view>
#include <vector>

namespace glissade::files {

/// " (did you mean 'name'?)" with the known name that is the fewest typing errors away from `word`; empty if all names
/// are too many errors away. A typing error is an extra, a missing or a wrong character, or two characters that changed
/// places.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace glissade::files
