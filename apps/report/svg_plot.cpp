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

/// Of the ticks at the axis of values.
double least_step_of(const Plot& plot) {
  return plot.counts ? 1.0 : 0.0;
}

Canvas canvas_for(const Plot& plot) {
  AxisRange x = extent_of(plot.series, &PlotSeries::x);
  if (x.low == x.high) x = rounded_range(x.low, x.high, kMostTicksX);
  const AxisRange y = extent_of(plot.series, &PlotSeries::y);
  return {x, rounded_range(y.low, y.high, kMostTicksY, least_step_of(plot))};
}

std::string line(double x1, double y1, double x2, double y2, const char* css_class) {
  return "<line class=\"" + std::string(css_class) + "\" x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) +
         "\" x2=\"" + coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\"/>\n";
}

std::string label(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
         html_escaped(text) + "</text>\n";
}

/// The horizontal axis at the height `y`.
template <typename ToX>
std::string axis_below(const AxisRange& range, const ToX& to_x, double y, const std::string& name) {
  std::string svg;
  const AxisTicks ticks = axis_ticks(range.low, range.high, kMostTicksX);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double x = to_x(ticks.values[i]);
    svg += line(x, y, x, y + 5.0, "axis");
    svg += label(x, y + 19.0, "middle", ticks.labels[i]);
  }
  svg += line(to_x(range.low), y, to_x(range.high), y, "axis");
  return svg + label(0.5 * (to_x(range.low) + to_x(range.high)), y + 40.0, "middle", name, " class=\"name\"");
}

std::string axes(const Plot& plot, const Canvas& canvas) {
  const double right = kWidth - kRight;
  const double bottom = kHeight - kBottom;
  std::string svg;
  const AxisTicks ticks_y = axis_ticks(canvas.y.low, canvas.y.high, kMostTicksY, least_step_of(plot));
  for (std::size_t i = 0; i < ticks_y.values.size(); ++i) {
    const double y = canvas.to_y(ticks_y.values[i]);
    svg += line(kLeft, y, right, y, ticks_y.values[i] == 0.0 ? "zero" : "grid");
    svg += label(kLeft - 8.0, y + 4.0, "end", ticks_y.labels[i]);
  }
  svg += axis_below(
      canvas.x, [&](double x) { return canvas.to_x(x); }, bottom, plot.x_label);
  const double middle = 0.5 * (kTop + bottom);
  svg += label(16.0, middle, "middle", plot.y_label,
               " class=\"name\" transform=\"rotate(-90 16 " + coordinate(middle) + ")\"");
  return svg;
}

/// Which times lie where in the drawing, for a page with a replay.
std::string times_of(const AxisRange& times, double left, double bottom) {
  std::string attributes;
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{{"from", times.low},
                                                                                         {"to", times.high},
                                                                                         {"left", left},
                                                                                         {"right", kWidth - kRight},
                                                                                         {"top", kTop},
                                                                                         {"bottom", bottom}})
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

std::string svg_head(const std::string& title, double height) {
  return "<svg viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(height) +
         "\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" + html_escaped(title) + "\">\n";
}

}  // namespace

std::string svg_plot(const Plot& plot) {
  std::string svg = svg_head(plot.title, kHeight);
  const AxisRange x = extent_of(plot.series, &PlotSeries::x);
  const AxisRange y = extent_of(plot.series, &PlotSeries::y);
  if (x.low > x.high || y.low > y.high) {
    return svg + label(0.5 * kWidth, 0.5 * kHeight, "middle", "no data") + "</svg>\n";
  }
  const Canvas canvas = canvas_for(plot);
  if (plot.x_label == kTimeLabel) svg.insert(svg.find('>'), times_of(canvas.x, kLeft, kHeight - kBottom));
  svg += axes(plot, canvas);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    svg += curve(plot.series[i], canvas, i % kPlotColors);
  return svg + "</svg>\n";
}

std::string svg_strips(const StripChart& chart) {
  // Names stand above their strips, so that times lie where those of plots lie.
  constexpr double kName = 18.0;
  constexpr double kRow = kName + 22.0;
  constexpr std::size_t kMostSpans = 1500;
  const double bottom = kTop + kRow * static_cast<double>(chart.strips.size());
  std::string svg = svg_head(chart.title, bottom + kBottom);
  AxisRange times{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Strip& strip : chart.strips) {
    if (strip.spans.empty()) continue;
    times.low = std::min(times.low, strip.spans.front().begin);
    times.high = std::max(times.high, strip.spans.back().end);
  }
  if (!(times.low < times.high))
    return svg + label(0.5 * kWidth, 0.5 * (bottom + kBottom), "middle", "no data") + "</svg>\n";
  svg.insert(svg.find('>'), times_of(times, kLeft, bottom));
  const auto to_x = [&](double time) {
    return kLeft + (time - times.low) / (times.high - times.low) * (kWidth - kLeft - kRight);
  };
  double y = kTop;
  for (const Strip& strip : chart.strips) {
    svg += label(kLeft, y + 0.7 * kName, "start", strip.name);
    for (const StripSpan& span : coarsened(strip, kMostSpans).spans) {
      svg += "<rect class=\"span c" + std::to_string(span.word % kPlotColors) + "\" x=\"" +
             coordinate(to_x(span.begin)) + "\" y=\"" + coordinate(y + kName) + "\" width=\"" +
             coordinate(to_x(span.end) - to_x(span.begin)) + "\" height=\"" + coordinate(kRow - kName - 4.0) + "\"/>\n";
    }
    y += kRow;
  }
  return svg + axis_below(times, to_x, bottom, kTimeLabel) + "</svg>\n";
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
