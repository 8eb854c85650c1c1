#pragma once

/// Foretells whether another step in the same call is worth its cost. Steps shrink fast: on flat faces the first one
/// already arrives at the optimum, on curved ones the second is by orders of magnitude shorter. What is left undone is
/// made up for by the first step of the next call.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class StepForecast {
 public:
  /// Begins a call for parts that are led by these metaphors. No step has been made yet. Margins in metres.
  void begin_call(std::span<const Metaphor> parts, double largest_margin, double smallest_margin);

  /// Notes a step of the call.
  void note(const Step& step);

  /// Whether what the parts would still move in this call can be expected to be too little to matter.
  bool is_rest_worthless() const;

  /// To be called when a hand takes hold or lets go: earlier calls tell nothing any more.
  void forget() { seen_.clear(); }

 private:
  using Lengths = std::array<double, kMaxParts>;  // metres, of each part

  /// A step of an earlier call, and the sum of those after it.
  struct Seen {
    Lengths step{};
    Lengths rest{};
    int calls = 0;  // since then; 0: nothing was seen
  };

  void learn();
  double rest_by_shrinking(std::size_t p) const;
  double rest_by_earlier_call(std::size_t p) const;

  std::size_t count_ = 0;  // of parts
  double least_ = 0.0;     // metres: less is never worth a step
  Lengths most_left_{};
  double margin_ = 0.0;  // metres
  std::vector<Step> steps_;
  std::vector<Seen> seen_;  // by the number of the step in its call
};

}  // namespace glissade::haptics
