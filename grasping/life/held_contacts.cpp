#include "life/held_contacts.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace glissade::grasping {
namespace {

double sum_of(const std::vector<double>& rates, const std::vector<double>& values) {
  return std::inner_product(rates.begin(), rates.end(), values.begin(), 0.0);
}

}  // namespace

HeldContacts::HeldContacts(std::shared_ptr<const KinematicChain> chain, std::size_t palm)
    : chain_(std::move(chain)),
      palm_(palm),
      X_WL_(chain_->links().size()),
      X_WL_target_(chain_->links().size()),
      last_(chain_->links().size()) {}

void HeldContacts::begin(const std::vector<LinkContact>& contacts) {
  std::fill(last_.begin(), last_.end(), std::nullopt);
  contacts_ = contacts;
}

HeldContacts::LastContact HeldContacts::last_contact(const LinkContact& touch, const Eigen::Isometry3d& X_VW,
                                                     const Posture& visible) const {
  const haptics::Contact& contact = touch.contact;
  std::vector<double> rates(visible.values.size(), 0.0);
  chain_->add_rates(touch.link, contact.p_W, contact.n_W, X_WL_, rates);
  for (std::size_t v = 0; v < rates.size(); ++v) {
    if (chain_->moves(v, palm_)) rates[v] = 0.0;
  }
  const double opened = sum_of(rates, visible.values);
  return {.touch = touch,
          .p_L = X_WL_[touch.link].inverse(Eigen::Isometry) * contact.p_W,
          .q_V = X_VW * contact.q_W(),
          .n_V = X_VW.linear() * contact.n_W,
          .rates = std::move(rates),
          .opened = opened};
}

void HeldContacts::update(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
                          const Posture& visible, const Posture& target) {
  contacts_ = contacts;
  left_.clear();
  chain_->poses(visible.X_WR, visible.values, X_WL_);
  chain_->poses(target.X_WR, target.values, X_WL_target_);
  const Eigen::Isometry3d X_VW = X_WV.inverse(Eigen::Isometry);
  for (std::size_t link = 0; link < last_.size(); ++link) {
    std::optional<LastContact>& last = last_[link];
    const LinkContact* deepest = nullptr;
    for (const LinkContact& touch : contacts) {
      const bool is_of_both = touch.link == link && touch.contact.obstacle == body;
      if (is_of_both && (deepest == nullptr || touch.depth > deepest->depth)) deepest = &touch;
    }
    if (deepest != nullptr) {
      last = last_contact(*deepest, X_VW, visible);
      continue;
    }
    if (!last) continue;
    const double away = sum_of(last->rates, target.values) - last->opened;
    // A target that lies within the part goes anywhere aside: nothing may hold the fingers of the glove back.
    const Eigen::Vector3d from_part_V = X_VW * (X_WL_target_[link] * last->p_L) - last->q_V;
    const double aside = away > -kWithin_m ? (from_part_V - last->n_V.dot(from_part_V) * last->n_V).norm() : 0.0;
    if (away > kAway_m || aside > kAside_m) {
      left_.push_back(link);
      last.reset();
    } else if (away < kNear_m) {
      haptics::Contact& contact = last->touch.contact;
      contact.n_W = X_WV.linear() * last->n_V;
      contact.p_W = X_WL_[link] * last->p_L;
      contact.gap = contact.margin + std::max(0.0, away);
      last->touch.depth = std::max(0.0, -away);
      contacts_.push_back(last->touch);
    }
  }
}

}  // namespace glissade::grasping
