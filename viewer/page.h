#pragma once

/// The page on which one sees a scene, live from a `ViewServer` or by itself in a report; and its colours.

#include <array>
#include <string_view>

namespace glissade::viewer {

/// One HTML file with its scripts and styles. It loads the model and connects to the server that it came from.
std::string_view page() noexcept;

/// A colour of the page's palette, on a light screen: red, green and blue of sRGB, 0 to 1.
/// Throws std::logic_error if the palette has none of this name.
std::array<double, 3> color(std::string_view name);

}  // namespace glissade::viewer
