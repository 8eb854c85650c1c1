#include "life/push.h"

#include <algorithm>

namespace glissade::grasping {

void Push::add(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
               const haptics::SlidingPart& part) {
  const Eigen::Vector3d p_Wref = X_WV * part.p_Vref();
  for (const LinkContact& touch : contacts) {
    const haptics::Contact& contact = touch.contact;
    if (contact.obstacle == body)
      planes_.push_back({-contact.n_W, contact.q_W() - p_Wref, std::min(0.0, kPress_m - touch.depth)});
  }
}

geometry::Displacement Push::displacement(double radius) {
  double deepest = 0.0;
  for (const ContactPlane& plane : planes_)
    deepest = std::max(deepest, -plane.room);
  const geometry::Displacement d = slide_past({}, planes_, radius, forces_, kCompliance);
  return d.scaled(geometry::fraction_within(d, radius, deepest));
}

}  // namespace glissade::grasping
