#pragma once

/// What a line plot shows, and how a long line is thinned without losing its peaks.

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::apps {

/// One line of a plot; `x` ascending, as many values in `y`. A value that is not finite interrupts the line.
struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// One plot. The labels carry the units, say "force [N]".
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
};

/// At most `most` (≥ 4) points that look like `series` when drawn: the first, the last, and the least and the greatest
/// value of each stretch between, so that no peak is lost.
PlotSeries decimated(const PlotSeries& series, std::size_t most);

}  // namespace glissade::apps
