#pragma once

/// Line plots as inline SVG, styled by the page that holds them (see `html_report.h`).

#include <cstddef>
#include <string>

#include <glissade/apps/plot.h>

namespace glissade::apps {

/// Lines take the style classes `c0`, `c1`, ... in turn; the page defines this many.
inline constexpr std::size_t kPlotColors = 6;

/// The plot as one `<svg>` element, without its title; each line has at most 2000 points.
std::string svg_plot(const Plot& plot);

/// `text` with the characters that mean something in HTML and XML replaced.
std::string html_escaped(const std::string& text);

}  // namespace glissade::apps
