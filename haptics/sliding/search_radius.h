#pragma once

/// The radius of contact searches: as small as the motion allows, and limited where searches find too many pairs.

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class SearchRadius {
 public:
  SearchRadius();

  /// Chooses the reach (metres) of the next cycle. `depenetration` (metres) bounds the motion out of an obstacle in
  /// this tick.
  void choose(const SimulatedParts& shared, double depenetration);
  double reach() const { return reach_; }

  /// Makes every pair within reach a candidate, except pairs of `ignored` bodies. A search looks some ticks ahead.
  /// Returns whether the candidates changed.
  bool look(SimulatedParts& shared, std::span<const BodyPair> ignored);

  /// Notes the step that was taken; the next reach depends on it.
  void note(const Step& step);
  /// Length of the last step, metres.
  double last_step() const { return last_step_; }

 private:
  double reach_ = 0.0;
  double last_step_ = 0.0;
  bool last_clipped_ = false;
  double limit_;  // metres; adapts to the number of pairs that searches find
};

}  // namespace glissade::haptics
