#include "clasp/closing_rows.h"

#include <algorithm>

namespace glissade::grasping {

void ClosingRows::set(const Posture& posture, const ChainStep& wanted, std::span<const contact::Contact> contacts,
                      std::span<const std::size_t> movers) {
  planes_.clear();
  gaps_.clear();
  rates_.clear();
  p_WR_ = posture.X_WR.translation();
  root_ = wanted.root;
  wanted_ = wanted.values;
  chain_.poses(posture.X_WR, posture.values, X_WL_);
  for (const contact::Contact& contact : contacts)
    add(contact, movers[static_cast<std::size_t>(contact.part)]);
}

void ClosingRows::add(const contact::Contact& contact, std::size_t link) {
  const Eigen::Vector3d r_W = contact.p_W - p_WR_;
  planes_.push_back({contact.n_W, r_W, std::max(0.0, contact.gap - contact.margin)});
  gaps_.push_back({link, contact.gap - contact.margin});
  const std::size_t first = rates_.size();
  rates_.resize(first + columns_, 0.0);
  rates_[first] = contact.n_W.dot(root_.v + root_.w.cross(r_W));
  const std::span<double> of_values(rates_.data() + first + 1, wanted_.size());
  chain_.add_rates(link, contact.p_W, contact.n_W, X_WL_, of_values);
  for (std::size_t v = 0; v < wanted_.size(); ++v)
    of_values[v] *= wanted_[v];
}

void ClosingRows::share_shortfalls() {
  std::fill(shortfalls_.begin(), shortfalls_.end(), 0.0);
  for (const LinkGap& gap : gaps_)
    shortfalls_[gap.link] = std::max(shortfalls_[gap.link], -gap.beyond_margin);
  for (std::size_t row = 0; row < gaps_.size(); ++row)
    planes_[row].room = std::max(0.0, gaps_[row].beyond_margin + shortfalls_[gaps_[row].link]);
}

void ClosingRows::bar(std::size_t link) {
  planes_.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0});
  rates_.push_back(-1.0);
  for (std::size_t value = 0; value < wanted_.size(); ++value)
    rates_.push_back(chain_.moves(value, link) ? -1.0 : 0.0);
}

}  // namespace glissade::grasping
