#pragma once

/// The data that all stages of a simulation cycle share: held parts, riders, contact scene and candidate pairs.

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/sliding_rules.h>

#include "scene/contact_scene.h"
#include "search/candidate_pairs.h"
#include "sliding/held_part_state.h"
#include "sliding/riders.h"
#include "work/work_budget.h"

namespace glissade::haptics {

/// One displacement for each part; those beyond the number of parts are zero.
using Displacements = std::array<geometry::Displacement, kMaxParts>;

/// Not thread-safe.
struct SimulatedParts {
  /// Throws std::invalid_argument as `MultiPartSliding` does, except for overlaps, which are not checked here.
  SimulatedParts(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                 const std::vector<RiderChain>& chains, const SlidingRules& rules);

  std::size_t count() const { return states.size(); }
  std::span<const geometry::Displacement> of_parts(const Displacements& d) const { return {d.data(), count()}; }
  /// Metres that all ghosts together moved in this tick, plus those by which their offsets shrank.
  double ghost_motion() const;

  SlidingRules rules;
  std::int64_t affordable_search;  // work of searches in a call, on average, that are not too large
  std::int64_t work_of_steps;      // of a call, without searches
  ContactScene scene;
  CandidatePairs candidates;
  std::vector<HeldPartState> states;
  Riders riders;
  double largest_margin = 0.0;  // metres, of all bodies
  double smallest_margin = std::numeric_limits<double>::infinity();

 private:
  void note_margin(double margin);
};

/// A displacement of all parts that is certified free of collisions, and how it came about.
struct Step {
  Displacements displacements{};
  std::array<double, kMaxParts> lengths{};  ///< their motion bounds, metres
  std::array<bool, kMaxParts> arrives{};    ///< nothing shortened or turned the displacement
  double length = 0.0;                      ///< the sum of the lengths: two bodies come nearer by at most this
  bool clipped = false;         ///< shortened by the reach, the slew, missing candidates or a missing certificate
  bool is_reach_short = false;  ///< shortened by the reach
  bool is_uncovered = false;    ///< shortened because the candidates might not be complete farther on
  Displacements missed{};       ///< what reach and candidates have cut off its end
  bool is_plain = false;        ///< neither clipped nor damped, by the rows of contacts alone
};

}  // namespace glissade::haptics
