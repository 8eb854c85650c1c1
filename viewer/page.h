#pragma once

/// The HTML page that shows a scene, and the colours of the page. The page receives a live scene from a `ViewServer`.
/// In a report, it works without a server.

#include <array>
#include <string_view>

namespace glissade::viewer {

/// The page as one HTML file with its scripts and styles. The page loads the model from its server, and connects to
/// this server.
std::string_view page() noexcept;

/// A colour of the page's palette for light screens: red, green and blue of sRGB, from 0 to 1. Throws std::logic_error
/// if the palette has no colour `name`.
std::array<double, 3> color(std::string_view name);

}  // namespace glissade::viewer
