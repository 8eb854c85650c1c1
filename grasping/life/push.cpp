#include "life/push.h"

#include <algorithm>
#include <cstddef>

namespace glissade::grasping {

void Push::clear() {
  planes_.clear();
  depths_.clear();
  speeds_m_per_ms_.clear();
  fastest_m_per_ms_ = 0.0;
}

void Push::add(const GraspingHand& hand, std::int32_t body, const Eigen::Isometry3d& X_WV,
               const contact::SlidingPart& part) {
  for (const LinkContact& touch : hand.clasp().contacts()) {
    if (touch.contact.obstacle == body) add(touch, hand.speed_of(touch.link), X_WV * part.p_Vref());
  }
}

void Push::add(const LinkContact& touch, double link_m_per_ms, const Eigen::Vector3d& p_Wref) {
  planes_.push_back({-touch.contact.n_W, touch.contact.q_W() - p_Wref, 0.0});
  depths_.push_back(touch.depth);
  speeds_m_per_ms_.push_back(link_m_per_ms);
  fastest_m_per_ms_ = std::max(fastest_m_per_ms_, link_m_per_ms);
}

geometry::Displacement Push::displacement(double radius, double milliseconds) {
  if (fastest_m_per_ms_ < kStill_m_per_ms) return {};
  double longest = 0.0;
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const double resistance =
        GraspingHand::kResistance_m + speeds_m_per_ms_[i] * std::max(0.0, milliseconds - kRegularCall_ms);
    const double too_deep = std::max(0.0, depths_[i] - resistance);
    planes_[i].room = -too_deep;
    longest = std::max(longest, too_deep);
  }
  longest = std::min(longest, kFastest * fastest_m_per_ms_ * std::min(milliseconds, kLongestPush_ms));
  if (longest == 0.0) return {};
  const geometry::Displacement d = slide_past({}, planes_, radius, forces_, kCompliance);
  return d.scaled(geometry::fraction_within(d, radius, longest));
}

}  // namespace glissade::grasping
