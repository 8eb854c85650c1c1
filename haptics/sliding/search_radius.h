#pragma once

/// The radius of contact searches: as small as the motion allows, and limited where searches find too many pairs.

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class SearchRadius {
 public:
  SearchRadius();

  /// Chooses the reach (metres) of the next cycle; `depenetration` (metres) is how far a part may be moved out of an
  /// obstacle in this tick.
  void choose(const SimulatedParts& shared, double depenetration);
  double reach() const { return reach_; }

  /// Makes sure that every pair within reach is a candidate. A search looks some ticks ahead. Returns whether the
  /// candidates changed.
  bool look(SimulatedParts& shared, std::span<const BodyPair> ignored);

  /// The step that was taken: the next reach follows it.
  void note(const Step& step);
  /// Metres of the last step.
  double last_step() const { return last_step_; }

 private:
  double reach_ = 0.0;
  double last_step_ = 0.0;
  bool last_clipped_ = false;
  double limit_;  // metres; adapts to the number of pairs that searches find
};

}  // namespace glissade::haptics
