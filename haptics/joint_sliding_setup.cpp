#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/collision/rigid_pose.h>
#include <glissade/haptics/joint_sliding.h>

#include "sliding_constants.h"

namespace glissade::haptics {
namespace {

double default_margin(const SlidingPart& part_V) {
  return std::clamp(1e-4 * part_V.radius(), 2e-6, 10e-6);
}

std::vector<std::shared_ptr<const SlidingPart>> bodies_of(const std::vector<HeldPart>& parts) {
  std::vector<std::shared_ptr<const SlidingPart>> bodies;
  for (const HeldPart& part : parts)
    bodies.push_back(part.part_V);
  return bodies;
}

std::vector<double> margins_of(const std::vector<HeldPart>& parts, const SlidingRules& rules) {
  std::vector<double> margins;
  for (const HeldPart& part : parts)
    margins.push_back(rules.margin.value_or(default_margin(*part.part_V)));
  return margins;
}

void check(const std::vector<HeldPart>& parts, const SlidingRules& rules) {
  if (parts.empty() || parts.size() > kMaxParts) {
    throw std::invalid_argument(std::to_string(parts.size()) + " parts cannot be held at once; 1 to " +
                                std::to_string(kMaxParts) + " can");
  }
  const auto is_stiffness = [](double k) { return k > 0.0 && std::isfinite(k); };
  for (const HeldPart& part : parts) {
    if (part.stiffness && !(is_stiffness(part.stiffness->translational) && is_stiffness(part.stiffness->rotational))) {
      throw std::invalid_argument("the stiffness with which " + part.name + " is held is not a positive number");
    }
  }
  const Friction& friction = rules.friction;
  if (!(friction.sliding >= 0.0 && friction.at_rest >= friction.sliding && std::isfinite(friction.at_rest))) {
    throw std::invalid_argument("the coefficients of friction must be numbers, 0 <= sliding <= at rest, not " +
                                std::to_string(friction.sliding) + " and " + std::to_string(friction.at_rest));
  }
}

}  // namespace

JointSliding::JointSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                           const SlidingRules& rules)
    : rules_((check(parts, rules), rules)),
      surroundings_(std::move(obstacles), bodies_of(parts), margins_of(parts, rules)),
      candidates_(surroundings_, kLargestReach_m + kMostLookAhead_m, rules.has_search_thread),
      certificate_(surroundings_),
      overlaps_(surroundings_),
      grips_(parts.size()),
      reach_limit_(kLargestReach_m) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const HeldPart& held = parts[p];
    const std::optional<Eigen::Isometry3d> X_WV = collision::rigid_pose(held.X_WV_start);
    if (!X_WV) throw std::invalid_argument("the start pose of " + held.name + " is not a rotation and translation");
    surroundings_.place(p, *X_WV);
    Part& part = parts_.emplace_back(Part{.part_V = held.part_V,
                                          .metaphor = held.metaphor,
                                          .stiffness = held.stiffness.value_or(default_stiffness(*held.part_V)),
                                          .margin = rules.margin.value_or(default_margin(*held.part_V)),
                                          .is_scripted = held.is_scripted,
                                          .anti_jam = AntiJam(held.part_V->radius())});
    part.result.X_WG = *X_WV;
    part.result.X_WT = *X_WV;
    part.result.X_WV = *X_WV;
    part.result.X_WV_of_contacts = *X_WV;
    part.X_WA = *X_WV;
    part.X_WV_before = *X_WV;
    largest_margin_ = std::max(largest_margin_, part.margin);
  }
  for (const Obstacle& obstacle : surroundings_.obstacles())
    largest_margin_ = std::max(largest_margin_, obstacle.margin.value_or(0.0));
  find_overlaps(parts);
}

/// What overlaps at the start is refused or will be led out, as the rules say.
void JointSliding::find_overlaps(const std::vector<HeldPart>& parts) {
  const double touching = 4.0 * certificate_.certain_distance();
  const std::span<const Obstacle> obstacles = surroundings_.obstacles();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (std::size_t other = 0; other < surroundings_.body_of_part(p); ++other) {
      const BodyPair bodies{static_cast<std::int32_t>(other), static_cast<std::int32_t>(surroundings_.body_of_part(p))};
      const double floor = surroundings_.floor(bodies.obstacle, bodies.part);
      const double gap = gap_of(bodies, std::max(floor, 2.0 * touching));
      if (gap > touching) {
        if (gap >= floor) continue;
        surroundings_.start_near(bodies.obstacle, bodies.part, gap);
        near_starts_.push_back(bodies);
        continue;
      }
      const bool is_obstacle = other < obstacles.size();
      if (is_obstacle && rules_.overlap == OverlapRule::kLeadOut && !parts[p].is_scripted) {
        overlaps_.add(bodies);
        continue;
      }
      const std::string& name = is_obstacle ? obstacles[other].name : parts[other - obstacles.size()].name;
      throw std::invalid_argument(parts[p].name + " collides with " + name + " at its start pose");
    }
  }
}

/// Metres between two bodies, or `limit` if that is less.
double JointSliding::gap_of(const BodyPair& pair, double limit) {
  const PlacedBody& obstacle = surroundings_.bodies()[static_cast<std::size_t>(pair.obstacle)];
  const PlacedBody& part = surroundings_.bodies()[static_cast<std::size_t>(pair.part)];
  const Eigen::Isometry3d X_OV = obstacle.X_WB.inverse(Eigen::Isometry) * part.X_WB;
  return collision::gap_lower_bound(obstacle.body->tree, part.body->tree, X_OV, workspace_, limit);
}

/// Bodies that started nearer to each other than their floor get it back as they come apart.
void JointSliding::raise_floors() {
  std::erase_if(near_starts_, [&](const BodyPair& bodies) {
    const double whole = kFloorOfMargin * surroundings_.margin(bodies.obstacle, bodies.part);
    const double gap = gap_of(bodies, 2.0 * whole);
    if (0.95 * gap > surroundings_.floor(bodies.obstacle, bodies.part)) {
      surroundings_.start_near(bodies.obstacle, bodies.part, gap);
    }
    return 0.95 * gap >= whole;
  });
}

}  // namespace glissade::haptics
