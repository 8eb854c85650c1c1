#pragma once

/// Line plots and strip charts as inline SVG, styled by the page that holds them (see `html_report.h`).

#include <cstddef>
#include <string>

#include <glissade/apps/report/plot.h>
#include <glissade/apps/report/strip_chart.h>

namespace glissade::apps {

/// Number of the style classes `c0`, `c1`, ... that lines take in turn. The page defines them.
inline constexpr std::size_t kPlotColors = 6;

/// The plot as one `<svg>` element, without its title; each line has at most 2000 points.
std::string svg_plot(const Plot& plot);

/// The chart in the same way; each strip has at most 1500 spans.
std::string svg_strips(const StripChart& chart);

/// `text` with the special characters of HTML and XML escaped.
std::string html_escaped(const std::string& text);

}  // namespace glissade::apps
