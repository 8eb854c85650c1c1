#pragma once

/// The data of a line plot, and a decimation of long lines that keeps their peaks.

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::apps {

/// One line of a plot. `x` ascends; `y` has as many values. A value that is not finite interrupts the line.
struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// The label of an axis that shows the time of a run.
inline constexpr const char* kTimeLabel = "time [s]";

/// One plot. The labels carry the units, for example "force [N]".
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool counts = false;  ///< of things: the axis of values has whole numbers only
};

/// At most `most` (≥ 4) points that look like `series` when drawn: the first, the last, and the minimum and maximum of
/// each stretch between them, so that no peak is lost.
PlotSeries decimated(const PlotSeries& series, std::size_t most);

}  // namespace glissade::apps
