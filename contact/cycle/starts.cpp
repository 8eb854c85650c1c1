#include "cycle/starts.h"

#include <algorithm>
#include <array>

namespace glissade::contact {
namespace {

/// A part that is blocked on its way out for so many calls is left to the hand.
constexpr int kMostBlockedCalls = 20;
/// Of a push: a part that moves less is blocked.
constexpr double kBlocked = 0.01;

}  // namespace

Starts::Starts(SimulatedParts& shared) : shared_(shared) {
  for (std::size_t i = 0; i < shared.seats.size(); ++i) {
    const Seat& seat = shared.seats[i];
    seats_.push_back(i);
    if (!seat.way_out_W) continue;
    const Eigen::Vector3d& p_W = shared.states[part_of(i)].result.X_WV.translation();
    ways_out_.push_back({i, seat.way_out_W->normalized(), p_W + *seat.way_out_W, seat.way_out_W->norm()});
  }
  std::stable_sort(ways_out_.begin(), ways_out_.end(),
                   [](const WayOut& a, const WayOut& b) { return a.left > b.left; });
  find_ignored();
  for (std::size_t part = 0; part < shared.count(); ++part) {
    const auto body = static_cast<std::int32_t>(shared.scene.body_of_mover(part));
    for (std::int32_t other = 0; other < body; ++other)
      look({other, body});
  }
}

bool Starts::is_seated(const BodyPair& bodies) const {
  return std::any_of(seats_.begin(), seats_.end(),
                     [&](std::size_t seat) { return shared_.seats[seat].bodies == bodies; });
}

void Starts::look(const BodyPair& bodies) {
  if (is_seated(bodies)) return;
  const double min_clearance = shared_.scene.min_clearance(bodies.obstacle, bodies.part);
  const double gap = gap_of(bodies, min_clearance);
  if (gap >= min_clearance) return;
  shared_.scene.start_near(bodies.obstacle, bodies.part, gap);
  near_starts_.push_back(bodies);
}

bool Starts::leave_seats() {
  const std::size_t before = seats_.size();
  std::erase_if(seats_, [&](std::size_t seat) {
    const BodyPair& bodies = shared_.seats[seat].bodies;
    const double min_clearance = shared_.scene.min_clearance(bodies.obstacle, bodies.part);
    if (gap_of(bodies, min_clearance) < min_clearance) return false;
    shared_.riders.remove(shared_.chain_of_seat(seat));
    std::erase_if(ways_out_, [&](const WayOut& way) { return way.seat == seat; });
    return true;
  });
  if (seats_.size() == before) return false;
  find_ignored();
  return true;
}

void Starts::find_ignored() {
  ignored_.clear();
  for (const std::size_t seat : seats_) {
    const BodyPair& bodies = shared_.seats[seat].bodies;
    ignored_.push_back(bodies);
    for (std::int32_t other = 0; other < shared_.inset_of_seat(0); ++other) {
      const bool can_touch =
          ContactScene::can_touch(shared_.scene.group(static_cast<std::size_t>(other)), ContactScene::kChain);
      const bool is_inert = shared_.scene.leader(other) == shared_.scene.leader(bodies.part);
      if (other != bodies.obstacle && can_touch && !is_inert) ignored_.push_back({other, shared_.inset_of_seat(seat)});
    }
  }
  std::sort(ignored_.begin(), ignored_.end());
}

void Starts::depenetrate(double most) {
  depenetration_ = 0.0;
  std::array<bool, kMaxParts> is_aimed{};
  for (WayOut& way : ways_out_) {
    const std::size_t part = part_of(way.seat);
    if (is_aimed[part] || !shared_.states[part].is_held()) continue;
    is_aimed[part] = true;
    push_on(way, most);
    depenetration_ = most;
  }
  std::erase_if(ways_out_, [](const WayOut& way) { return way.left <= 0.0 || way.blocked_calls > kMostBlockedCalls; });
}

void Starts::push_on(WayOut& way, double most) {
  HeldPartState& part = shared_.states[part_of(way.seat)];
  const double left = way.n_W.dot(way.end_W - part.result.X_WV.translation());
  const bool is_blocked = way.left - left < kBlocked * std::min(most, way.left);
  way.blocked_calls = is_blocked ? way.blocked_calls + 1 : 0;
  way.left = left;
  part.X_WS = part.result.X_WV;
  part.X_WS.translation() += std::clamp(left, 0.0, most) * way.n_W;
}

bool Starts::is_pushed_out(std::size_t part) const {
  return std::any_of(ways_out_.begin(), ways_out_.end(), [&](const WayOut& way) { return part_of(way.seat) == part; });
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

}  // namespace glissade::contact
