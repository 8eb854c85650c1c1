#include "cycle/riders.h"

#include <algorithm>

#include <glissade/base/assert.h>

namespace glissade::contact {

Riders::Riders(ContactScene& scene, const std::vector<RiderChain>& chains) : scene_(scene) {
  auto next = static_cast<std::int32_t>(scene.body_of_mover(scene.first_rider()));
  first_bodies_.push_back(next);
  for (const RiderChain& chain : chains)
    first_bodies_.push_back(next += static_cast<std::int32_t>(chain.bodies.size()));
  X_VB_.assign(scene.movers().size() - scene.first_rider(), Eigen::Isometry3d::Identity());
  is_absent_.assign(X_VB_.size(), 1);
  find_inert_pairs();
}

bool Riders::place(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB) {
  const std::int32_t first = first_bodies_[chain];
  GLISSADE_ASSERT(std::ssize(X_WB) == first_bodies_[chain + 1] - first);
  for (std::size_t i = 0; i < X_WB.size(); ++i) {
    const std::int32_t body = first + static_cast<std::int32_t>(i);
    scene_.place(static_cast<std::size_t>(body) - scene_.obstacles().size(), X_WB[i]);
    hold_on(body);
  }
  if (X_WB.empty() || !is_absent(first)) return false;
  std::fill_n(is_absent_.begin() + scene_.rider(first), X_WB.size(), char{0});
  find_inert_pairs();
  return true;
}

void Riders::remove(std::size_t chain) {
  attach(chain, ContactScene::kStands);
  for (std::int32_t body = first_bodies_[chain]; body < first_bodies_[chain + 1]; ++body)
    is_absent_[static_cast<std::size_t>(scene_.rider(body))] = 1;
  find_inert_pairs();
}

void Riders::attach(std::size_t chain, std::int32_t part) {
  for (std::int32_t body = first_bodies_[chain]; body < first_bodies_[chain + 1]; ++body) {
    scene_.set_leader(body, part);
    hold_on(body);
  }
  find_inert_pairs();
}

/// Notes where a rider is on its part.
void Riders::hold_on(std::int32_t body) {
  const std::int32_t part = scene_.leader(body);
  if (part == ContactScene::kStands) return;
  const Eigen::Isometry3d& X_WV = scene_.bodies()[scene_.body_of_mover(static_cast<std::size_t>(part))].X_WB;
  X_VB_[static_cast<std::size_t>(body - first_bodies_.front())] =
      X_WV.inverse(Eigen::Isometry) * scene_.bodies()[static_cast<std::size_t>(body)].X_WB;
}

void Riders::follow(std::int32_t part) {
  const Eigen::Isometry3d X_WV = scene_.bodies()[scene_.body_of_mover(static_cast<std::size_t>(part))].X_WB;
  for (std::int32_t body = first_bodies_.front(); body < first_bodies_.back(); ++body) {
    if (scene_.leader(body) != part) continue;
    const auto rider = static_cast<std::size_t>(body - first_bodies_.front());
    scene_.place(scene_.first_rider() + rider, X_WV * X_VB_[rider]);
  }
}

double Riders::lever(std::int32_t part) const {
  double lever = 0.0;
  for (std::int32_t body = first_bodies_.front(); body < first_bodies_.back(); ++body) {
    if (scene_.leader(body) != part) continue;
    lever = std::max(lever, scene_.lever(static_cast<std::size_t>(body) - scene_.obstacles().size()));
  }
  return lever;
}

void Riders::find_inert_pairs() {
  inert_pairs_.clear();
  for (std::int32_t rider = first_bodies_.front(); rider < first_bodies_.back(); ++rider) {
    for (std::int32_t other = 0; other < rider; ++other) {
      if (scene_.leader(other) != scene_.leader(rider) && !is_absent(other) && !is_absent(rider)) continue;
      const int group = scene_.group(static_cast<std::size_t>(other));
      if (ContactScene::can_touch(group, scene_.group(static_cast<std::size_t>(rider))))
        inert_pairs_.push_back({other, rider});
    }
  }
  std::sort(inert_pairs_.begin(), inert_pairs_.end());
}

}  // namespace glissade::contact
