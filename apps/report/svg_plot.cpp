#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <utility>

#include <glissade/apps/report/plot_axis.h>
#include <glissade/apps/report/svg_plot.h>

namespace glissade::apps {

namespace {

// The drawing's size and margins in its own units, which are pixels at full width.
constexpr double kWidth = 900.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 76.0;
constexpr double kRight = 16.0;
constexpr double kTop = 14.0;
constexpr double kBottom = 48.0;
constexpr int kMostTicksX = 10;
constexpr int kMostTicksY = 6;
constexpr std::size_t kMostPoints = 2000;

/// The mapping from data to the drawing.
struct Canvas {
  AxisRange x;
  AxisRange y;

  double to_x(double value) const { return kLeft + (value - x.low) / (x.high - x.low) * (kWidth - kLeft - kRight); }
  double to_y(double value) const {
    return kHeight - kBottom - (value - y.low) / (y.high - y.low) * (kHeight - kTop - kBottom);
  }
};

/// A coordinate of the drawing; a hundredth of a pixel is plenty.
std::string coordinate(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
  return buffer.data();
}

/// Smallest and greatest finite value over all series; an empty range (low > high) without finite values.
AxisRange extent_of(const std::vector<PlotSeries>& series, std::vector<double> PlotSeries::*values) {
  AxisRange extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const PlotSeries& one : series) {
    for (const double value : one.*values) {
      if (!std::isfinite(value)) continue;
      extent.low = std::min(extent.low, value);
      extent.high = std::max(extent.high, value);
    }
  }
  return extent;
}

Canvas canvas_for(const std::vector<PlotSeries>& series) {
  AxisRange x = extent_of(series, &PlotSeries::x);
  if (x.low == x.high) x = rounded_range(x.low, x.high, kMostTicksX);
  const AxisRange y = extent_of(series, &PlotSeries::y);
  return {x, rounded_range(y.low, y.high, kMostTicksY)};
}

std::string line(double x1, double y1, double x2, double y2, const char* css_class) {
  return "<line class=\"" + std::string(css_class) + "\" x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) +
         "\" x2=\"" + coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\"/>\n";
}

std::string label(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
         html_escaped(text) + "</text>\n";
}

std::string axes(const Plot& plot, const Canvas& canvas) {
  const double right = kWidth - kRight;
  const double bottom = kHeight - kBottom;
  std::string svg;
  const AxisTicks ticks_y = axis_ticks(canvas.y.low, canvas.y.high, kMostTicksY);
  for (std::size_t i = 0; i < ticks_y.values.size(); ++i) {
    const double y = canvas.to_y(ticks_y.values[i]);
    svg += line(kLeft, y, right, y, ticks_y.values[i] == 0.0 ? "zero" : "grid");
    svg += label(kLeft - 8.0, y + 4.0, "end", ticks_y.labels[i]);
  }
  const AxisTicks ticks_x = axis_ticks(canvas.x.low, canvas.x.high, kMostTicksX);
  for (std::size_t i = 0; i < ticks_x.values.size(); ++i) {
    const double x = canvas.to_x(ticks_x.values[i]);
    svg += line(x, bottom, x, bottom + 5.0, "axis");
    svg += label(x, bottom + 19.0, "middle", ticks_x.labels[i]);
  }
  svg += line(kLeft, bottom, right, bottom, "axis");
  svg += label(0.5 * (kLeft + right), kHeight - 8.0, "middle", plot.x_label, " class=\"name\"");
  const double middle = 0.5 * (kTop + bottom);
  svg += label(16.0, middle, "middle", plot.y_label,
               " class=\"name\" transform=\"rotate(-90 16 " + coordinate(middle) + ")\"");
  return svg;
}

/// Which times lie where in the drawing, for a page with a replay.
std::string times_of(const Canvas& canvas) {
  std::string attributes;
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{{"from", canvas.x.low},
                                                                                         {"to", canvas.x.high},
                                                                                         {"left", kLeft},
                                                                                         {"right", kWidth - kRight},
                                                                                         {"top", kTop},
                                                                                         {"bottom", kHeight - kBottom}})
    attributes += " data-" + std::string(name) + "=\"" + coordinate(value) + "\"";
  return attributes;
}

std::string curve(const PlotSeries& series, const Canvas& canvas, std::size_t color) {
  const PlotSeries points = decimated(series, kMostPoints);
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const bool finite = std::isfinite(points.x[i]) && std::isfinite(points.y[i]);
    if (finite) {
      path +=
          (pen_down ? "L" : "M") + coordinate(canvas.to_x(points.x[i])) + " " + coordinate(canvas.to_y(points.y[i]));
    }
    pen_down = finite;
  }
  return "<path class=\"line c" + std::to_string(color) + "\" d=\"" + path + "\"/>\n";
}

}  // namespace

std::string svg_plot(const Plot& plot) {
  std::string svg = "<svg viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(kHeight) +
                    "\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" + html_escaped(plot.title) +
                    "\">\n";
  const AxisRange x = extent_of(plot.series, &PlotSeries::x);
  const AxisRange y = extent_of(plot.series, &PlotSeries::y);
  if (x.low > x.high || y.low > y.high) {
    return svg + label(0.5 * kWidth, 0.5 * kHeight, "middle", "no data") + "</svg>\n";
  }
  const Canvas canvas = canvas_for(plot.series);
  if (plot.x_label == kTimeLabel) svg.insert(svg.find('>'), times_of(canvas));
  svg += axes(plot, canvas);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    svg += curve(plot.series[i], canvas, i % kPlotColors);
  return svg + "</svg>\n";
}

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += character;
    }
  }
  return result;
}

}  // namespace glissade::apps
