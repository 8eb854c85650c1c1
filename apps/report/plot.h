#pragma once

/// The data of a line plot.

#include <string>
#include <vector>

namespace glissade::apps {

/// One line of a plot, which bounds its number of points itself, as `GrowingCurve` does. `x` ascends; `y` has as many
/// values. A value that is not finite interrupts the line.
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
  bool steps = false;   ///< a value holds up to the next point
  /// If not empty, the values are numbers of these words, in colours: each line is a strip, and a word holds up to the
  /// next point.
  std::vector<std::string> words{};
};

}  // namespace glissade::apps
