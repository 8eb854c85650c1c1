#include "query/distance_front.h"

#include <cmath>

namespace glissade::collision {

void DistanceFront::follow(const DopTree& base, const DopTree& other, const QueryFrame& frame) {
  const std::array<std::uint64_t, 2> ids{base.id(), other.id()};
  bool afresh = most_entries_ != 0 && entries_.size() > most_entries_;
  if (ids_ != ids) {
    ids_ = ids;
    nearest_.reset();
    afresh = true;
  } else {
    // As in `CoherentFront::follow`.
    const double turned = (frame.R_MN - R_MN_).norm() * std::sqrt(0.5) + 2.0 * frame.rotation_defect;
    const double moved = (frame.p_MN - p_MN_).norm() + frame.ratio * turned;
    moved_ += moved * (1.0 + 1e-12) + 2.0 * frame.uncertainty;
  }
  if (afresh) {
    entries_.clear();
    expiry_.clear();
    moved_ = 0.0;
    most_entries_ = 0;
  }
  R_MN_ = frame.R_MN;
  p_MN_ = frame.p_MN;
}

void DistanceFront::add(const Entry& entry, double gap) {
  entries_.push_back(entry);
  expiry_.push_back(moved_ + gap);
}

void DistanceFront::take_expired(double distance, std::vector<Entry>& open) {
  const double clock = (moved_ + distance) * (1.0 + 1e-12);  // covers the rounding of both sums
  open.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (expiry_[i] < clock) {
      open.push_back(entries_[i]);
    } else {
      entries_[kept] = entries_[i];
      expiry_[kept++] = expiry_[i];
    }
  }
  entries_.resize(kept);
  expiry_.resize(kept);
}

// Entries are refined but never joined, so after a long way there are more of them than a search afresh would leave.
void DistanceFront::end_search() {
  constexpr std::size_t kMostGrowth = 2;
  constexpr std::size_t kSmallFront = 64;
  if (most_entries_ == 0) most_entries_ = kMostGrowth * entries_.size() + kSmallFront;
}

}  // namespace glissade::collision
