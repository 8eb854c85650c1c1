#pragma once

/// A vector over time, for a plot.

#include <array>
#include <string>

#include <Eigen/Core>

#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/report/plot.h>

namespace glissade::apps {

class VectorCurve {
 public:
  /// Times ascend from call to call.
  void add(double time_s, const Eigen::Vector3d& value);
  /// Its magnitude and its components, one line each.
  Plot plot(std::string title, std::string label) const;

 private:
  std::array<GrowingCurve, 4> curves_{GrowingCurve("magnitude"), GrowingCurve("x"), GrowingCurve("y"),
                                      GrowingCurve("z")};
};

}  // namespace glissade::apps
