#include "life/link_speeds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glissade/geometry/displacement.h>

namespace glissade::grasping {

LinkSpeeds::LinkSpeeds(std::shared_ptr<const KinematicChain> chain,
                       std::vector<std::shared_ptr<const contact::SlidingPart>> bodies)
    : chain_(std::move(chain)),
      bodies_(std::move(bodies)),
      X_WL_(chain_->links().size()),
      X_WL_last_(chain_->links().size()),
      speeds_(chain_->links().size()) {}

void LinkSpeeds::forget() {
  has_last_ = false;
  std::fill(speeds_.begin(), speeds_.end(), 0.0);
}

void LinkSpeeds::follow(const Posture& target, double milliseconds) {
  std::swap(X_WL_, X_WL_last_);
  chain_->poses(target.X_WR, target.values, X_WL_);
  if (!std::exchange(has_last_, true) || milliseconds <= 0.0) return;
  const double share_of_newest = 1.0 - std::exp(-milliseconds / kMean_ms);
  auto body = bodies_.begin();
  for (std::size_t link = 0; link < speeds_.size(); ++link) {
    if (chain_->links()[link].mesh == nullptr) continue;
    const contact::SlidingPart& part = **body++;
    const geometry::Displacement d = geometry::displacement_between(X_WL_last_[link], X_WL_[link], part.p_Vref());
    speeds_[link] += share_of_newest * (geometry::motion_bound(d, part.radius()) / milliseconds - speeds_[link]);
  }
}

}  // namespace glissade::grasping
