#pragma once

/// The page on which one sees a scene, live from a `ViewServer` or by itself in a report.

#include <string_view>

namespace glissade::viewer {

/// One HTML file with its scripts and styles. It loads the model and connects to the server that it came from.
std::string_view page() noexcept;

}  // namespace glissade::viewer
