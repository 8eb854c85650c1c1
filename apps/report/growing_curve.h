#pragma once

/// A line of a plot that grows with a run, in bounded memory.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/report/plot.h>

namespace glissade::apps {

/// Keeps its ends, and the minimum and the maximum of each of about a thousand equal stretches, so that no peak is
/// lost. When there are too many of them, two become one.
class GrowingCurve {
 public:
  explicit GrowingCurve(std::string name) : name_(std::move(name)) {}

  /// x ascends from call to call; both are finite.
  void add(double x, double y);
  /// The line so far, as fine as a page draws it.
  PlotSeries series() const;

 private:
  struct Point {
    double x;
    double y;
  };
  struct Stretch {
    Point least;
    Point greatest;

    void extend(const Stretch& other);
  };

  std::string name_;
  Point first_{};
  Point last_{};
  std::vector<Stretch> stretches_;
  std::size_t points_of_stretch_ = 1;
  std::size_t points_of_last_ = 0;
};

}  // namespace glissade::apps
