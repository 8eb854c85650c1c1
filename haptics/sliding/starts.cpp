#include "sliding/starts.h"

#include <algorithm>
#include <stdexcept>

#include <glissade/collision/dop_query.h>

namespace glissade::haptics {

Starts::Starts(SimulatedParts& shared, const std::vector<HeldPart>& parts, double touching)
    : shared_(shared), overlaps_(shared.scene) {
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (std::size_t other = 0; other < shared_.scene.body_of_mover(part); ++other)
      look(parts, part, other, touching);
  }
}

void Starts::look(const std::vector<HeldPart>& parts, std::size_t part, std::size_t other, double touching) {
  ContactScene& scene = shared_.scene;
  const BodyPair bodies{static_cast<std::int32_t>(other), static_cast<std::int32_t>(scene.body_of_mover(part))};
  const double min_clearance = scene.min_clearance(bodies.obstacle, bodies.part);
  const double gap = gap_of(bodies, std::max(min_clearance, 2.0 * touching));
  if (gap > touching) {
    if (gap >= min_clearance) return;
    scene.start_near(bodies.obstacle, bodies.part, gap);
    near_starts_.push_back(bodies);
    return;
  }
  const std::span<const Obstacle> obstacles = scene.obstacles();
  const bool is_obstacle = other < obstacles.size();
  if (is_obstacle && shared_.rules.overlap == OverlapRule::kDepenetrate && !parts[part].script) {
    overlaps_.add(bodies);
    return;
  }
  const std::string& name = is_obstacle ? obstacles[other].name : parts[other - obstacles.size()].name;
  throw std::invalid_argument(parts[part].name + " collides with " + name + " at its start pose");
}

void Starts::depenetrate(double most) {
  depenetration_ = 0.0;
  if (overlaps_.empty()) return;
  if (overlaps_.update()) shared_.candidates.clear();
  for (std::size_t p = 0; p < shared_.count(); ++p) {
    HeldPartState& part = shared_.states[p];
    const WayOut* way = overlaps_.way_out_of(p);
    if (way == nullptr || !part.is_held()) continue;
    part.X_WS = part.result.X_WV;
    part.X_WS.translation() += std::min(most, way->depth) * way->n_W;
    depenetration_ = most;
  }
}

/// Distance (metres) of two bodies, at most `limit`.
double Starts::gap_of(const BodyPair& pair, double limit) {
  const PlacedBody& obstacle = shared_.scene.bodies()[static_cast<std::size_t>(pair.obstacle)];
  const PlacedBody& part = shared_.scene.bodies()[static_cast<std::size_t>(pair.part)];
  const Eigen::Isometry3d X_OV = obstacle.X_WB.inverse(Eigen::Isometry) * part.X_WB;
  return collision::distance(obstacle.body->tree, part.body->tree, X_OV, workspace_, limit).distance;
}

void Starts::restore_min_clearances() {
  ContactScene& scene = shared_.scene;
  std::erase_if(near_starts_, [&](const BodyPair& bodies) {
    const double whole = kMinClearanceOfMargin * scene.margin(bodies.obstacle, bodies.part);
    const double gap = gap_of(bodies, 2.0 * whole);
    if (0.95 * gap > scene.min_clearance(bodies.obstacle, bodies.part)) {
      scene.start_near(bodies.obstacle, bodies.part, gap);
    }
    return 0.95 * gap >= whole;
  });
}

}  // namespace glissade::haptics
