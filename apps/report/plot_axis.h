#pragma once

/// Round numbers for the axes of a plot.

#include <string>
#include <vector>

namespace glissade::apps {

/// Ticks at multiples of 1, 2 or 5 times a power of ten.
struct AxisTicks {
  double step;
  std::vector<double> values;       ///< ascending, all within the given range
  std::vector<std::string> labels;  ///< one per value, all with the same number of decimals
};

/// Between 2 and `most` + 1 ticks for the range from `low` to `high`; both finite, `low` < `high`, `most` ≥ 2. Fewer
/// where the step would be less than `least_step`, which is 0 or a step of the kind above.
AxisTicks axis_ticks(double low, double high, int most, double least_step = 0.0);

/// A range of values with room to draw in.
struct AxisRange {
  double low;
  double high;
};

/// The smallest range between multiples of the tick step that holds `low` to `high`; a single value gets room on both
/// sides.
AxisRange rounded_range(double low, double high, int most, double least_step = 0.0);

}  // namespace glissade::apps
