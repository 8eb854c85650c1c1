#pragma once

/// Lines of a plot that grow with a run, in bounded memory.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

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

/// A plot of such lines.
class GrowingPlot {
 public:
  /// Of a plot without lines, and their names.
  GrowingPlot(Plot plot, const std::vector<std::string>& names)
      : plot_(std::move(plot)), curves_(names.begin(), names.end()) {}

  void add(std::size_t line, double x, double y) { curves_[line].add(x, y); }
  Plot plot() const;

 private:
  Plot plot_;
  std::vector<GrowingCurve> curves_;
};

/// A vector over time.
class VectorPlot {
 public:
  VectorPlot(std::string title, std::string label)
      : plot_({std::move(title), kTimeLabel, std::move(label), {}}, {"magnitude", "x", "y", "z"}) {}

  void add(double time_s, const Eigen::Vector3d& value);
  Plot plot() const { return plot_.plot(); }

 private:
  GrowingPlot plot_;
};

}  // namespace glissade::apps
