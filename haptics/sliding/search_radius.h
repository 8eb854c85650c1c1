#pragma once

/// The radius of contact searches: as small as the motion allows, and limited where searches find too many pairs.

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class SearchRadius {
 public:
  SearchRadius();

  /// Chooses the reach (metres) of the next cycle, and the farther one of the contacts ahead. `depenetration` (metres)
  /// bounds the motion out of an obstacle in this tick; `milliseconds` as in `advance`.
  void choose(const SimulatedParts& shared, double depenetration, double milliseconds);
  double reach() const { return reach_; }
  /// Metres; at least `reach`.
  double reach_ahead() const { return reach_ahead_; }

  /// Makes every pair within the reach ahead a candidate, except pairs of `ignored` bodies. A search looks some ticks
  /// farther. Returns whether the candidates changed. Where the work of a call does not suffice for the search, the
  /// candidates do not cover the reach afterwards. The next call then goes on with the search if its radius is the
  /// smallest, and otherwise begins another one with a smaller radius.
  bool look(SimulatedParts& shared, std::span<const BodyPair> ignored);

  /// Notes the step that was taken; the next reach depends on it.
  void note(const Step& step);
  /// Length of the last step, metres.
  double last_step() const { return last_step_; }

 private:
  double reach_ = 0.0;
  double reach_ahead_ = 0.0;
  double last_step_ = 0.0;
  bool last_clipped_ = false;
  // Metres; they adapt to the number of pairs that searches find.
  double limit_;
  double limit_ahead_;
  // Metres of the reach, and of the look-ahead; they adapt to the work of searches.
  double limit_by_work_;
  double limit_of_look_;
};

}  // namespace glissade::haptics
