#pragma once

/// Smoothed flex values of a hand that holds something.

#include <span>
#include <vector>

namespace glissade::grasping {

/// Follows small changes of flex values slowly and large ones at once: the noise of a glove, of some degrees from
/// sample to sample, does not shake fingers that hold a part, and fingers that plainly open are not late. Not
/// thread-safe.
class SteadyFingers {
 public:
  /// Begins anew at these values (rad).
  void begin(std::span<const double> values) { values_.assign(values.begin(), values.end()); }
  /// The smoothed values, `milliseconds` after the last ones.
  std::span<const double> follow(std::span<const double> values, double milliseconds);

 private:
  std::vector<double> values_;
};

}  // namespace glissade::grasping
