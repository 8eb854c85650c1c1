#include "sliding/overlaps.h"

#include <algorithm>

namespace glissade::haptics {

bool Overlaps::update() {
  ways_out_.clear();
  const std::size_t before = pairs_.size();
  std::erase_if(pairs_, [&](const BodyPair& pair) {
    const PlacedBody& obstacle = scene_.bodies()[static_cast<std::size_t>(pair.obstacle)];
    const PlacedBody& part = scene_.bodies()[static_cast<std::size_t>(pair.part)];
    const double margin = scene_.margin(pair.obstacle, pair.part);
    const collision::Penetration penetration = collision::find_way_out(
        obstacle.body->tree, part.body->tree, obstacle.X_WB.inverse() * part.X_WB, workspace_, margin);
    if (penetration.depth() == 0.0) return true;
    ways_out_.push_back({pair, obstacle.X_WB.linear() * penetration.way_out_A.normalized(), penetration.depth()});
    return false;
  });
  std::stable_sort(ways_out_.begin(), ways_out_.end(),
                   [](const WayOut& a, const WayOut& b) { return a.depth > b.depth; });
  return pairs_.size() != before;
}

const WayOut* Overlaps::way_out_of(std::size_t part) const {
  const auto body = static_cast<std::int32_t>(scene_.body_of_mover(part));
  const auto way = std::find_if(ways_out_.begin(), ways_out_.end(),
                                [&](const WayOut& candidate) { return candidate.bodies.part == body; });
  return way == ways_out_.end() ? nullptr : &*way;
}

}  // namespace glissade::haptics
