#pragma once

/// Foretells whether another step in the same call is worth its cost. Steps shrink fast: on flat faces the first one
/// already arrives at the optimum, on curved ones the second is by orders of magnitude shorter. What is left undone is
/// made up for by the first step of the next call.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cycle/simulated_parts.h"

namespace glissade::contact {

/// What a forecast needs to know of a part.
struct PartToForecast {
  Metaphor metaphor;
  double lever;  ///< metres, as in `HeldPartState`
};

/// Not thread-safe.
class StepForecast {
 public:
  using Lengths = std::array<double, kMaxParts>;  ///< metres, of each part

  /// Begins a call for these parts. No step has been made yet. Margins in metres.
  void begin_call(std::span<const PartToForecast> parts, double largest_margin, double smallest_margin);

  /// Notes a step of the call.
  void note(const Step& step);

  /// Whether what the parts would still move in this call can be expected to be too little to matter. There must have
  /// been a step.
  bool is_remainder_worthless() const;
  /// The same of a remainder that is known.
  bool is_worthless(const Lengths& remainder) const;
  /// Whether the last three steps have led each part back to where it was before them. Contacts that bend may lead
  /// parts in such a circle for as long as a call lasts. Parts that close in on their optimum from all sides come back
  /// less exactly.
  bool goes_in_circle() const;

  /// To be called when a hand takes hold or lets go: what was before tells nothing any more.
  void forget();

 private:
  /// A step of an earlier call, and what the parts moved, or would have moved, after it.
  struct Seen {
    Lengths step{};
    Lengths remainder{};
    int calls = 0;  // since then; 0: nothing was seen
  };

  void learn();
  Lengths expected_remainders() const;
  double by_shrinking(std::size_t p) const;
  double by_earlier_call(std::size_t p) const;

  std::size_t count_ = 0;  // of parts
  double least_ = 0.0;     // metres: less is never worth a step
  Lengths most_left_{};
  double margin_ = 0.0;  // metres
  Lengths levers_{};     // of the parts
  std::vector<Step> steps_;
  std::vector<Seen> seen_;  // by the number of the step in its call
};

}  // namespace glissade::contact
