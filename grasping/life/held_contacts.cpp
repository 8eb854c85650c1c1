#include "life/held_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace glissade::grasping {
namespace {

double sum_of(const std::vector<double>& rates, const std::vector<double>& values) {
  return std::inner_product(rates.begin(), rates.end(), values.begin(), 0.0);
}

}  // namespace

HeldContacts::HeldContacts(std::shared_ptr<const KinematicChain> chain, std::size_t palm,
                           std::span<const std::size_t> flexions)
    : chain_(std::move(chain)),
      palm_(palm),
      flexions_(flexions.begin(), flexions.end()),
      X_WL_(chain_->links().size()),
      X_WL_target_(chain_->links().size()),
      last_(chain_->links().size()) {}

void HeldContacts::begin(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
                         const Posture& visible) {
  std::fill(last_.begin(), last_.end(), std::nullopt);
  update(contacts, body, X_WV, visible, visible);
}

std::vector<double> HeldContacts::opening_rates(const LinkContact& touch) const {
  const auto rates_along = [&](const Eigen::Vector3d& n_W) {
    std::vector<double> rates(chain_->values().size(), 0.0);
    chain_->add_rates(touch.link, touch.contact.p_W, n_W, X_WL_, rates);
    return rates;
  };
  std::vector<double> rates = rates_along(touch.contact.n_W);
  const std::array along{rates_along(Eigen::Vector3d::UnitX()), rates_along(Eigen::Vector3d::UnitY()),
                         rates_along(Eigen::Vector3d::UnitZ())};
  for (const std::size_t v : flexions_)
    rates[v] = -std::hypot(along[0][v], along[1][v], along[2][v]);
  for (std::size_t v = 0; v < rates.size(); ++v) {
    if (chain_->moves(v, palm_)) rates[v] = 0.0;
  }
  return rates;
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
      const contact::Contact& contact = deepest->contact;
      std::vector<double> rates = opening_rates(*deepest);
      const double opened = sum_of(rates, visible.values);
      last = {*deepest,
              X_WL_[link].inverse(Eigen::Isometry) * contact.p_W,
              X_VW * contact.q_W(),
              X_VW.linear() * contact.n_W,
              std::move(rates),
              opened};
      continue;
    }
    if (!last) continue;
    const double away = sum_of(last->rates, target.values) - last->opened;
    // One that is closed may go anywhere aside: nothing may hold the fingers of the glove back.
    const Eigen::Vector3d from_part_V = X_VW * (X_WL_target_[link] * last->p_L) - last->q_V;
    const double aside = away > -kWithin_m ? (from_part_V - last->n_V.dot(from_part_V) * last->n_V).norm() : 0.0;
    if (away > kAway_m || aside > kAside_m) {
      left_.push_back(link);
      last.reset();
    } else if (away < kNear_m) {
      contact::Contact& contact = last->touch.contact;
      contact.n_W = X_WV.linear() * last->n_V;
      contact.p_W = X_WL_[link] * last->p_L;
      contact.gap = contact.margin + std::max(0.0, away);
      last->touch.depth = std::max(0.0, -away);
      contacts_.push_back(last->touch);
    }
  }
}

}  // namespace glissade::grasping
