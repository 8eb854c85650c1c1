#include "life/push.h"

namespace glissade::grasping {

void Push::add(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
               const haptics::SlidingPart& part) {
  const Eigen::Vector3d p_Wref = X_WV * part.p_Vref();
  for (const LinkContact& touch : contacts) {
    const haptics::Contact& contact = touch.contact;
    if (contact.obstacle == body) planes_.push_back({-contact.n_W, contact.q_W() - p_Wref, -touch.depth});
  }
}

}  // namespace glissade::grasping
