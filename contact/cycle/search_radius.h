#pragma once

/// The radius of contact searches: as small as the motion allows, and limited where searches find too many pairs.

#include "cycle/simulated_parts.h"

namespace glissade::contact {

/// Not thread-safe.
class SearchRadius {
 public:
  SearchRadius();

  /// Chooses the reach (metres) of the next cycle, and the farther one of the contacts ahead. `depenetration` (metres)
  /// bounds the motion out of an obstacle in this tick; `milliseconds` as in `advance`. The first cycle of an answer
  /// mostly makes nearly the whole step.
  void choose(const SimulatedParts& shared, double depenetration, double milliseconds, bool is_first_cycle);
  /// Of the rows, metres. Candidates may cover less: a step then goes only where they cover its path.
  double reach() const { return reach_; }
  /// Of the contacts ahead, metres; at least `reach`. Candidates may cover less.
  double reach_ahead() const { return reach_ahead_; }
  /// What the candidates must cover around the parts for the cycle, metres: after `look` they do, unless the work of a
  /// call does not suffice or a search finds too many pairs.
  double needed() const { return needed_; }

  /// Makes pairs near the parts candidates, except pairs of `ignored` bodies, unless the last candidates still cover
  /// the reach ahead: those along the way that the last step has missed, or in a first cycle those of the search ahead.
  /// Little is needed; where the candidates do not cover it, a search makes every pair within the reach ahead a
  /// candidate, and looks some ticks farther. Requests the next search in time. Returns whether the candidates changed.
  /// Where the work of a call does not suffice for the search, the next call goes on with it if its radius is the
  /// smallest, and otherwise begins another one with a smaller radius. Where a search finds too many pairs, `needed` is
  /// not covered either: after the next `choose` the reach is shorter, or more pairs are allowed.
  bool look(SimulatedParts& shared, std::span<const BodyPair> ignored);
  /// Whether the last `look` has found a search too large, so that the next one is smaller or may have more pairs.
  bool has_shrunk() const { return has_shrunk_; }
  /// Requests the search for the first cycle of the next answer now, if the candidates will not serve for it. To be
  /// called after the last step of an answer. `look` requests other searches, so that their thread is not woken in
  /// vain.
  void prepare_next(SimulatedParts& shared, std::span<const BodyPair> ignored) const;

  /// Notes the step that was taken; the next reach depends on it.
  void note(const SimulatedParts& shared, const Step& step);
  /// Length of the last step, metres.
  double last_step() const { return last_step_; }

 private:
  bool look_along_missed(SimulatedParts& shared, double least, std::span<const BodyPair> ignored) const;
  void look_ahead(SimulatedParts& shared, std::span<const BodyPair> ignored) const;
  double farther(const SimulatedParts& shared) const;
  void shrink(CandidatePairs& candidates, double wanted);

  double reach_ = 0.0;
  double reach_ahead_ = 0.0;
  double needed_ = 0.0;
  bool is_first_cycle_ = false;
  bool has_shrunk_ = false;
  double next_step_ = 0.0;     // metres: the length that is expected of the main step of the next answer
  double least_radius_ = 0.0;  // metres: of the search for it, without its look-ahead
  double last_step_ = 0.0;
  bool was_reach_short_ = false;  // the last step
  Displacements missed_{};        // of the last step
  double missed_length_ = 0.0;    // metres: two bodies would have come nearer by at most so much
  // Metres; they adapt to the number of pairs that searches find.
  double limit_;
  double limit_ahead_;
  // Metres of the reach, and of the look-ahead; they adapt to the work of searches.
  double limit_by_work_;
  double limit_of_look_;
};

}  // namespace glissade::contact
