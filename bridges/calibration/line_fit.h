#pragma once

/// A line through points of which some may be wrong.

#include <optional>
#include <vector>

namespace glissade::bridges {

struct LinePoint {
  double x = 0.0;
  double y = 0.0;
  double tolerance = 1.0;  ///< of y: errors count in multiples of it
};

struct Line {
  double slope = 1.0;
  double offset = 0.0;

  double error(const LinePoint& point) const noexcept { return slope * point.x + offset - point.y; }
};

/// The line of least squares through the points that are within their tolerances of the line of least absolute errors.
/// Some line of least absolute errors passes through two of the points, so all pairs are tried. No value if no pair has
/// a slope in the range, or the slope of the result is outside of it. Cost O(n³).
std::optional<Line> robust_line(const std::vector<LinePoint>& points, double least_slope, double greatest_slope);

}  // namespace glissade::bridges
