#include "clasp/sight.h"

#include <algorithm>

namespace glissade::grasping {
namespace {

constexpr double kGreatestReach_m = 2.5e-3;
constexpr double kFirstLimit_m = 1e-3;
constexpr std::size_t kAffordablePairs = 100;  // of a link: where a search finds more, the next ones look less far
constexpr double kStepOfReach = 0.8;

}  // namespace

Sight::Sight(std::size_t movers, double least)
    : least_(std::max(kLeast_m, least)),
      reach_(movers, 0.0),
      next_reach_(movers, kGreatestReach_m),
      limit_(movers, kFirstLimit_m) {}

void Sight::choose(const contact::BodiesMotion& motion, double margin) {
  for (std::size_t m = 0; m < reach_.size(); ++m) {
    const double wanted = 1.5 * motion.length(m) + 2.0 * margin;
    reach_[m] = std::clamp(wanted, least_, std::min(next_reach_[m], limit_[m]));
  }
}

void Sight::choose_least() {
  std::fill(reach_.begin(), reach_.end(), least_);
}

void Sight::note_found(const contact::CertifiedBodies& bodies) {
  for (std::size_t m = 0; m < reach_.size(); ++m)
    limit_[m] = std::clamp(bodies.pair_count(m) > kAffordablePairs ? 0.5 * reach_[m] : 1.25 * limit_[m], least_,
                           kGreatestReach_m);
}

void Sight::note_taken(const contact::BodiesMotion* motion) {
  for (std::size_t m = 0; m < reach_.size(); ++m) {
    const double taken = motion != nullptr ? motion->length(m) : 0.0;
    const bool is_clipped = taken > 0.9 * kStepOfReach * reach_[m];
    next_reach_[m] =
        std::clamp(is_clipped ? 2.0 * reach_[m] : std::max(0.5 * reach_[m], 2.0 * taken), least_, kGreatestReach_m);
  }
}

double Sight::share_of(const contact::BodiesMotion& motion) const {
  double share = 1.0;
  for (std::size_t m = 0; m < reach_.size(); ++m) {
    const double seen = kStepOfReach * reach_[m];
    if (motion.length(m) > seen) share = std::min(share, seen / motion.length(m));
  }
  return share;
}

}  // namespace glissade::grasping
