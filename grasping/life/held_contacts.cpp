#include "life/held_contacts.h"

#include <algorithm>

namespace glissade::grasping {

void HeldContacts::begin(const std::vector<LinkContact>& contacts) {
  std::fill(last_.begin(), last_.end(), std::nullopt);
  contacts_ = contacts;
}

void HeldContacts::update(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
                          std::span<const Eigen::Isometry3d> X_WL, std::span<const Eigen::Isometry3d> X_WL_target) {
  contacts_ = contacts;
  left_.clear();
  const Eigen::Isometry3d X_VW = X_WV.inverse(Eigen::Isometry);
  for (std::size_t link = 0; link < last_.size(); ++link) {
    std::optional<LastContact>& last = last_[link];
    const LinkContact* deepest = nullptr;
    for (const LinkContact& touch : contacts) {
      const bool is_of_both = touch.link == link && touch.contact.obstacle == body;
      if (is_of_both && (deepest == nullptr || touch.depth > deepest->depth)) deepest = &touch;
    }
    if (deepest != nullptr) {
      const haptics::Contact& contact = deepest->contact;
      last = {*deepest, X_WL[link].inverse(Eigen::Isometry) * contact.p_W, X_VW * contact.q_W(),
              X_VW.linear() * contact.n_W};
      continue;
    }
    if (!last) continue;
    const Eigen::Vector3d from_part_V = X_VW * (X_WL_target[link] * last->p_L) - last->q_V;
    const double away = last->n_V.dot(from_part_V);
    // A target that lies within the part goes anywhere aside: nothing may hold the fingers of the glove back.
    const double aside = away > -kWithin_m ? (from_part_V - away * last->n_V).norm() : 0.0;
    if (away > kAway_m || aside > kAside_m) {
      left_.push_back(link);
      last.reset();
    } else if (away < kNear_m) {
      haptics::Contact& contact = last->touch.contact;
      contact.n_W = X_WV.linear() * last->n_V;
      contact.p_W = X_WL[link] * last->p_L;
      contact.gap = contact.margin + std::max(0.0, away);
      last->touch.depth = std::max(0.0, -away);
      contacts_.push_back(last->touch);
    }
  }
}

}  // namespace glissade::grasping
