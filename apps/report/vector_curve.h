#pragma once

/// A vector over time, for a plot.

#include <array>
#include <string>

#include <Eigen/Core>

#include <glissade/apps/report/plot.h>

namespace glissade::apps {

class VectorCurve {
 public:
  /// Times ascend from call to call.
  void add(double time_s, const Eigen::Vector3d& value);
  /// Its magnitude and its components, one line each. Once, at the end.
  Plot take(std::string title, std::string label);

 private:
  std::array<PlotSeries, 4> series_{{{"magnitude", {}, {}}, {"x", {}, {}}, {"y", {}, {}}, {"z", {}, {}}}};
};

}  // namespace glissade::apps
