#include "life/push.h"

#include <algorithm>

namespace glissade::grasping {

void Push::clear() {
  planes_.clear();
  fastest_m_per_ms_ = 0.0;
}

void Push::add(const GraspingHand& hand, std::int32_t body, const Eigen::Isometry3d& X_WV,
               const contact::SlidingPart& part) {
  for (const LinkContact& touch : hand.clasp().contacts()) {
    if (touch.contact.obstacle == body) add(touch, hand.speed_of(touch.link), X_WV * part.p_Vref());
  }
}

void Push::add(const LinkContact& touch, double link_m_per_ms, const Eigen::Vector3d& p_Wref) {
  const double too_deep = std::max(0.0, touch.depth - GraspingHand::kResistance_m);
  planes_.push_back({-touch.contact.n_W, touch.contact.q_W() - p_Wref, -too_deep});
  fastest_m_per_ms_ = std::max(fastest_m_per_ms_, link_m_per_ms);
}

geometry::Displacement Push::displacement(double radius, double milliseconds) {
  if (fastest_m_per_ms_ < kStill_m_per_ms) return {};
  double longest = 0.0;
  for (const ContactPlane& plane : planes_)
    longest = std::max(longest, -plane.room);
  longest = std::min(longest, kFastest * fastest_m_per_ms_ * std::min(milliseconds, kLongestPush_ms));
  if (longest == 0.0) return {};
  const geometry::Displacement d = slide_past({}, planes_, radius, forces_, kCompliance);
  return d.scaled(geometry::fraction_within(d, radius, longest));
}

}  // namespace glissade::grasping
