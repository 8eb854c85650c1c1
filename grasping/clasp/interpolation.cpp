#include "clasp/interpolation.h"

#include <algorithm>
#include <numeric>

namespace glissade::grasping {
namespace {

constexpr double kNothing_m = 1e-12;  // a mover that closes a contact by less does not close it
constexpr int kPasses = 4;

/// The number of the highest link that a value moves; values that move nothing come last.
std::size_t highest_link(const KinematicChain& chain, std::size_t value) {
  std::size_t link = 0;
  while (link < chain.links().size() && !chain.moves(value, link))
    ++link;
  return link;
}

}  // namespace

Interpolation::Interpolation(const KinematicChain& chain) : order_(1 + chain.values().size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin() + 1, order_.end(), [&](std::size_t a, std::size_t b) {
    return highest_link(chain, a - 1) < highest_link(chain, b - 1);
  });
  shares_.resize(order_.size());
  is_fixed_.resize(order_.size());
}

const std::vector<double>& Interpolation::find(const ClosingRows& rows, double bracket) {
  rows_ = &rows;
  std::fill(shares_.begin(), shares_.end(), 0.0);
  std::fill(is_fixed_.begin(), is_fixed_.end(), char{0});
  rooms_.resize(rows.count());
  for (std::size_t row = 0; row < rows.count(); ++row)
    rooms_[row] = rows.room(row);
  advance_together();
  advance_alone(bracket);
  return shares_;
}

void Interpolation::advance_together() {
  for (std::size_t stage = 0; stage < order_.size(); ++stage) {
    double share = 1.0;  // that the unfixed movers may still go
    for (const std::size_t mover : order_) {
      if (is_fixed_[mover] == 0) share = std::min(share, 1.0 - shares_[mover]);
    }
    std::size_t blocker = rows_->count();
    for (std::size_t row = 0; row < rows_->count(); ++row) {
      double rate = 0.0;
      for (const std::size_t mover : order_) {
        if (is_fixed_[mover] == 0) rate += rows_->rate(row, mover);
      }
      if (rate >= -kNothing_m || rooms_[row] >= -rate * share) continue;
      share = rooms_[row] / -rate;
      blocker = row;
    }
    for (const std::size_t mover : order_) {
      if (is_fixed_[mover] == 0) advance(mover, share);
    }
    if (blocker == rows_->count()) return;
    const auto highest = std::find_if(order_.begin(), order_.end(), [&](std::size_t mover) {
      return is_fixed_[mover] == 0 && rows_->rate(blocker, mover) < -kNothing_m;
    });
    if (highest == order_.end()) return;
    is_fixed_[*highest] = 1;
  }
}

void Interpolation::advance_alone(double bracket) {
  for (int pass = 0; pass < kPasses; ++pass) {
    bool any = false;
    for (const std::size_t mover : order_) {
      if (shares_[mover] >= 1.0) continue;
      const double gain = room_for(mover);
      if (!(gain > 0.0)) continue;
      advance(mover, gain);
      double motion = 0.0;
      for (std::size_t row = 0; row < rows_->count(); ++row)
        motion = std::max(motion, std::abs(rows_->rate(row, mover)) * gain);
      any = any || motion > bracket || rows_->count() == 0;
    }
    if (!any) return;
  }
}

/// The share by which a mover alone may go on.
double Interpolation::room_for(std::size_t mover) const {
  double share = 1.0 - shares_[mover];
  for (std::size_t row = 0; row < rows_->count(); ++row) {
    const double rate = rows_->rate(row, mover);
    if (rate < -kNothing_m) share = std::min(share, rooms_[row] / -rate);
  }
  return share;
}

void Interpolation::advance(std::size_t mover, double share) {
  shares_[mover] += share;
  for (std::size_t row = 0; row < rows_->count(); ++row)
    rooms_[row] = std::max(0.0, rooms_[row] + share * rows_->rate(row, mover));
}

}  // namespace glissade::grasping
