#pragma once

/// What the parts of a run do over time, for the plots of a report.

#include <cstddef>
#include <string>
#include <vector>

#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/report/word_curve.h>
#include <glissade/devices/haptic_state.h>

namespace glissade::apps {

class PartCurves {
 public:
  /// For parts of these names.
  explicit PartCurves(const std::vector<std::string>& names);

  /// The state of the part with this number. Its times ascend from call to call.
  void add(double time_s, std::size_t part, const devices::HapticPartState& state);
  /// Adds plots of lag, contacts and states. At the end.
  void finish(Report& report) const;

 private:
  GrowingPlot lags_;
  GrowingPlot angles_;
  GrowingPlot contacts_;
  std::vector<WordCurve> states_;
};

}  // namespace glissade::apps
