#pragma once

/// The data that all stages of a simulation cycle share: held parts, riders, contact scene and candidate pairs.

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/geometry/displacement.h>

#include "cycle/held_part_state.h"
#include "cycle/riders.h"
#include "cycle/seats.h"
#include "scene/contact_scene.h"
#include "search/candidate_pairs.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// The margin (metres) of a part where the rules give none.
double default_margin(const SlidingPart& part_V);

/// One displacement for each part; those beyond the number of parts are zero.
using Displacements = std::array<geometry::Displacement, kMaxParts>;

/// Not thread-safe.
struct SimulatedParts {
  /// Throws std::invalid_argument as `MultiPartSliding` does.
  SimulatedParts(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                 const std::vector<RiderChain>& chains, const SlidingRules& rules);

  std::size_t count() const { return states.size(); }
  /// The chain of riders that is the inset of a seat: it follows the chains of the caller.
  std::size_t chain_of_seat(std::size_t seat) const { return riders.chain_count() - seats.size() + seat; }
  /// The body of this inset.
  std::int32_t inset_of_seat(std::size_t seat) const {
    return static_cast<std::int32_t>(scene.bodies().size() - seats.size() + seat);
  }
  std::span<const geometry::Displacement> of_parts(const Displacements& d) const { return {d.data(), count()}; }
  /// Metres that all ghosts together moved in this tick, plus those by which their offsets shrank.
  double ghost_motion() const;

  SlidingRules rules;
  std::int64_t affordable_search;  // work of searches in a call, on average, that are not too large
  std::int64_t work_of_steps;      // of a call, without searches
  std::vector<Seat> seats;         // at the start
  ContactScene scene;
  CandidatePairs candidates;
  std::vector<HeldPartState> states;
  Riders riders;
  double largest_margin = 0.0;  // metres, of all bodies
  double smallest_margin = std::numeric_limits<double>::infinity();
  double largest_clearance = 0.0;  // metres: of all minimum clearances

 private:
  void note_margin(double margin);
  void place_insets();
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

}  // namespace glissade::contact
