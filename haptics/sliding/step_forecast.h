#pragma once

/// Foretells whether another step in the same call is worth its cost. Steps shrink fast: on flat faces the first one
/// already arrives at the optimum, on curved ones the next is by orders of magnitude shorter. What is left is made up
/// for by the first step of the next call.

#include <array>
#include <cstddef>
#include <vector>

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class StepForecast {
 public:
  /// Begins a call: no step has been made yet. `margin` in metres, the largest of all parts.
  void begin_call(double margin);

  /// Notes a step of the call.
  void note(const Step& step);

  /// Whether the step after the last one can be expected to be too short to matter.
  bool is_next_worthless() const;

 private:
  /// A step and the one after it in an earlier call, metres.
  struct Pair {
    double length = 0.0;
    double next = 0.0;
    int calls = 0;  // since then
  };

  double by_shrinking() const;
  double by_earlier_call() const;

  double margin_ = 0.0;
  double first_ = 0.0;  // metres: length of the first step of the call
  Step last_;
  std::array<double, kMaxParts> shrinks_{};  // of each part: the last step over the one before
  std::size_t count_ = 0;                    // of steps of the call
  std::vector<Pair> earlier_;                // by the number of the first step of the pair
};

}  // namespace glissade::haptics
