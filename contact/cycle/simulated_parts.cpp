#include "cycle/simulated_parts.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <glissade/geometry/displacement.h>

#include "certificate/moving_bodies.h"
#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

/// In units of `MovingBodies::certain_distance`: bodies closer than this touch at the start.
constexpr double kTouching = 4.0;

void check_rules(const SlidingRules& rules) {
  if (!(rules.contacts_ahead_ms >= 0.0 && std::isfinite(rules.contacts_ahead_ms))) {
    throw std::invalid_argument("the time for contacts ahead must be finite and not negative, not " +
                                std::to_string(rules.contacts_ahead_ms) + " ms");
  }
  if (rules.max_cycles < 1) {
    throw std::invalid_argument("a call of sliding needs at least one cycle, not " + std::to_string(rules.max_cycles));
  }
  if (rules.affordable_pairs < 1) throw std::invalid_argument("a search must be allowed to find at least one pair");
  if (rules.work_budget && *rules.work_budget < 2) {
    throw std::invalid_argument("a call of sliding needs a work budget of at least 2, not " +
                                std::to_string(*rules.work_budget));
  }
  const Friction& friction = rules.friction;
  if (friction.sliding >= 0.0 && friction.at_rest >= friction.sliding && std::isfinite(friction.at_rest)) return;
  throw std::invalid_argument("the coefficients of friction must be numbers, 0 <= sliding <= at rest, not " +
                              std::to_string(friction.sliding) + " and " + std::to_string(friction.at_rest));
}

const SlidingRules& checked(const SlidingRules& rules, const std::vector<HeldPart>& parts) {
  if (parts.empty() || parts.size() > kMaxParts) {
    throw std::invalid_argument(std::to_string(parts.size()) + " parts cannot be held at once; 1 to " +
                                std::to_string(kMaxParts) + " can");
  }
  for (const HeldPart& part : parts) {
    if (part.part_V == nullptr) throw std::invalid_argument(part.name + " needs a body, not a null pointer");
    if (part.stiffness) validate(*part.stiffness, part.name);
  }
  check_rules(rules);
  return rules;
}

/// Parts and riders with their margins and groups.
ContactScene make_scene(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                        const std::vector<RiderChain>& chains, const SlidingRules& rules) {
  std::vector<std::shared_ptr<const SlidingPart>> movers;
  std::vector<double> margins;
  for (const HeldPart& part : parts) {
    movers.push_back(part.part_V);
    margins.push_back(rules.margin.value_or(default_margin(*part.part_V)));
  }
  std::vector<int> groups(parts.size(), ContactScene::kPart);
  for (const RiderChain& chain : chains) {
    for (const auto& body : chain.bodies) {
      if (body == nullptr) throw std::invalid_argument("a rider needs a body, not a null pointer");
      movers.push_back(body);
      margins.push_back(chain.margin);
      groups.push_back(ContactScene::kChain);
    }
  }
  return {std::move(obstacles), std::move(movers), parts.size(), margins, groups};
}

Eigen::Isometry3d start_pose(const HeldPart& part) {
  const std::optional<Eigen::Isometry3d> X_WV =
      geometry::rigid_pose(part.script ? part.script->pose_at({}) : part.X_WV_start);
  if (!X_WV) throw std::invalid_argument("the start pose of " + part.name + " is not a rotation and translation");
  return *X_WV;
}

/// So far from the origin, no step could be proven.
void check_rounding(const std::string& part_name, double margin, double certain_distance) {
  if (certain_distance <= kMinClearanceOfMargin * margin) return;
  std::ostringstream sentence;
  sentence << "the scene reaches too far from the origin for the margin of " << part_name << ", " << margin
           << " m: a distance there is certain to " << certain_distance << " m only";
  throw std::invalid_argument(sentence.str());
}

std::vector<Seat> seats_at_start(const std::vector<Obstacle>& obstacles, const std::vector<HeldPart>& parts,
                                 const std::vector<RiderChain>& chains, const SlidingRules& rules) {
  ContactScene scene = make_scene(obstacles, parts, chains, rules);
  for (std::size_t p = 0; p < parts.size(); ++p)
    scene.place(p, start_pose(parts[p]));
  const double certain = MovingBodies(scene).certain_distance();
  for (const HeldPart& part : parts)
    check_rounding(part.name, rules.margin.value_or(default_margin(*part.part_V)), certain);
  return find_seats(scene, parts, rules.overlap, kTouching * certain);
}

/// The caller's chains, and one for each inset.
std::vector<RiderChain> with_insets(std::vector<RiderChain> chains, const std::vector<Seat>& seats) {
  for (const Seat& seat : seats)
    chains.push_back({{seat.inset_V}, seat.margin});
  return chains;
}

HeldPartState state_at_start(const HeldPart& held, const Eigen::Isometry3d& X_WV, const SlidingRules& rules) {
  HeldPartState state{.part_V = held.part_V,
                      .p_Vref = held.part_V->p_Vref(),
                      .metaphor = held.metaphor,
                      .stiffness = held.stiffness.value_or(stiffness_of_part(held.part_V->radius())),
                      .margin = rules.margin.value_or(default_margin(*held.part_V)),
                      .lever = held.part_V->radius(),
                      .script = held.script,
                      .may_search = rules.spiral_search && !held.script,
                      .spiral_search = SpiralSearch(held.part_V->radius())};
  state.result.X_WG = X_WV;
  state.result.X_WT = X_WV;
  state.result.X_WV = X_WV;
  state.result.X_WV_of_contacts = X_WV;
  state.result.X_WV_before_step = X_WV;
  state.X_WS = X_WV;
  state.X_WV_before = X_WV;
  return state;
}

}  // namespace

double default_margin(const SlidingPart& part_V) {
  return std::clamp(1e-4 * part_V.tree.radius(), 2e-6, 10e-6);
}

SimulatedParts::SimulatedParts(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                               const std::vector<RiderChain>& chains, const SlidingRules& sliding_rules)
    : rules(checked(sliding_rules, parts)),
      affordable_search(rules.work_budget ? *rules.work_budget / 2 : kUnlimitedWork),
      work_of_steps(rules.work_budget.value_or(kUnlimitedWork)),
      seats(seats_at_start(obstacles, parts, chains, rules)),
      scene(make_scene(std::move(obstacles), parts, with_insets(chains, seats), rules)),
      candidates(scene, kLargestReach_m + kMostLookAhead_m, rules.has_search_thread, work_of_steps),
      riders(scene, with_insets(chains, seats)) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Eigen::Isometry3d X_WV = start_pose(parts[p]);
    scene.place(p, X_WV);
    states.push_back(state_at_start(parts[p], X_WV, rules));
    note_margin(states.back().margin);
  }
  for (const Obstacle& obstacle : scene.obstacles()) {
    if (obstacle.margin) note_margin(*obstacle.margin);
  }
  for (const RiderChain& chain : chains)
    note_margin(chain.margin);
  place_insets();
}

void SimulatedParts::place_insets() {
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const Seat& seat = seats[i];
    const auto part = static_cast<std::size_t>(seat.bodies.part) - scene.obstacles().size();
    riders.place(chain_of_seat(i), {&states[part].result.X_WV, 1});
    riders.attach(chain_of_seat(i), static_cast<std::int32_t>(part));
    scene.set_min_clearance(seat.bodies.obstacle, inset_of_seat(i), seat.min_clearance);
    note_margin(seat.margin);
    largest_clearance = std::max(largest_clearance, seat.min_clearance);
  }
}

void SimulatedParts::note_margin(double margin) {
  largest_clearance = std::max(largest_clearance, kMinClearanceOfMargin * margin);
  largest_margin = std::max(largest_margin, margin);
  smallest_margin = std::min(smallest_margin, margin);
}

double SimulatedParts::ghost_motion() const {
  double sum = 0.0;
  for (const HeldPartState& part : states)
    sum += part.ghost_motion + part.closing;
  return sum;
}

}  // namespace glissade::contact
